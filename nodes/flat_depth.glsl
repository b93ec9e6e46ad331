// flat_depth.glsl: the depth of flat things, so that those in one plane never fight; for fragment shaders.
//
// u_depth_step: how many steps a layer lies behind lines in its plane (nodes/flat_order.h orders all flat layers).
const float kRelativeStep = 1e-3;
const float kAbsoluteStep = 2.5e-7;
const float kOrthographicStep = 2e-6;
const float kSlopePixels = 4.0;
const vec2 kLeastShare = vec2(0.25, 1e-4);
uniform float u_depth_step;

// Of how depth grows away from the eye: below or above zero with the depth buffer as OpenGL has it, or reversed.
bool sfIsDepthReversed() {
  bool is_perspective = gl_ProjectionMatrix[2][3] != 0.0;
  return (is_perspective ? gl_ProjectionMatrix[3][2] : gl_ProjectionMatrix[2][2]) > 0.0;
}

// gl_FragCoord.z moved away from the eye, by an amount and by steps. With q = 1 near and 0 far away either way round, the
// amount leaves q a share `least`, for at the horizon there is less than that left; what gives way to another has the
// smaller share: x of depth as OpenGL has it, y of one reversed, which holds far smaller ones apart. The steps keep layers
// apart beyond what rounding can do: q / (1 + step) keeps its order and never leaves the range; in perspective q goes with
// the reciprocal of the distance, so that the relative step is one of distance.
float sfStepBack(float amount, vec2 least, float steps) {
  bool is_perspective = gl_ProjectionMatrix[2][3] != 0.0;
  bool is_reversed = sfIsDepthReversed();
  float q = is_reversed ? gl_FragCoord.z : 1.0 - gl_FragCoord.z;
  vec2 step_size = is_perspective ? vec2(kRelativeStep, kAbsoluteStep) : vec2(0.0, kOrthographicStep);
  q = max(q - amount, (is_reversed ? least.y : least.x) * q);
  q /= 1.0 + steps * step_size.x + steps * step_size.y / max(q, 1e-12);
  return is_reversed ? q : 1.0 - q;
}

// Of a surface. A line in the plane has the depth of its own middle in all the pixels that it covers: that is some pixels
// of the plane's slope away, and those of the reference grid are moved by more than two. In perspective the slope comes
// from the reciprocal of the distance, which keeps its digits where depth rounds to few.
float sfFlatDepth() {
  bool is_perspective = gl_ProjectionMatrix[2][3] != 0.0;
  float scale = abs(gl_ProjectionMatrix[3][2]) * (sfIsDepthReversed() ? 1.0 : 0.5);
  float depth = is_perspective ? scale * gl_FragCoord.w : gl_FragCoord.z;
  float slope = max(abs(dFdx(depth)), abs(dFdy(depth)));
  return sfStepBack(kSlopePixels * slope, kLeastShare, u_depth_step);
}
