// flat_depth.glsl: the depth of flat things, so that those in one plane never fight; for fragment shaders.
//
// u_depth_step: how many steps a layer lies behind lines in its plane (nodes/flat_order.h orders all flat layers).
const float kRelativeStep = 1e-3;
const float kAbsoluteStep = 2.5e-7;
const float kOrthographicStep = 2e-6;
const float kSlopePixels = 2.0;
uniform float u_depth_step;

// gl_FragCoord.z moved away from the eye. A line in the plane has the depth of its own middle in all the pixels that it
// covers: that is a pixel or two of the plane's slope away. The steps keep layers apart beyond what rounding can do.
// With q = 1 near and 0 far away either way round, q / (1 + step) keeps its order and never leaves the range; in
// perspective q goes with the reciprocal of the distance, so that the relative step is one of distance.
float sfFlatDepth() {
  bool is_perspective = gl_ProjectionMatrix[2][3] != 0.0;
  // Of how depth grows away from the eye: below or above zero with the depth buffer as OpenGL has it, or reversed.
  bool is_reversed = (is_perspective ? gl_ProjectionMatrix[3][2] : gl_ProjectionMatrix[2][2]) > 0.0;
  float q = is_reversed ? gl_FragCoord.z : 1.0 - gl_FragCoord.z;
  float slope = max(abs(dFdx(gl_FragCoord.z)), abs(dFdy(gl_FragCoord.z)));
  vec2 step_size = is_perspective ? vec2(kRelativeStep, kAbsoluteStep) : vec2(0.0, kOrthographicStep);
  q /= 1.0 + u_depth_step * step_size.x + (kSlopePixels * slope + u_depth_step * step_size.y) / max(q, 1e-12);
  return is_reversed ? q : 1.0 - q;
}
