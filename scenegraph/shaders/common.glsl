// common.glsl: shared by every scene shader; the embed step puts it in place of the include line.
//
// u_linear_output (set by our view pipeline only): 1 when the target is scene-linear, 0 (the default, and so in an
// exported file in a stock viewer) when it shows what is written.
// u_viewport_height_px: height of the target, for sizes in metres; 720 where nobody sets it. u_pixel_ratio: pixels of the
// target to one of those that settings count in, above 1 on fine screens.
uniform float u_linear_output = 0.0;
uniform float u_viewport_height_px = 720.0;
uniform float u_pixel_ratio = 1.0;

// Exact sRGB decoding (IEC 61966-2-1).
vec3 sfLinearFromSrgb(vec3 srgb) {
  vec3 low = srgb / 12.92;
  vec3 high = pow((max(srgb, vec3(0.0)) + 0.055) / 1.055, vec3(2.4));
  return mix(high, low, lessThanEqual(srgb, vec3(0.04045)));
}

// No NaN, nothing below 0 and nothing that a half float cannot hold goes into a target. By bits: a compiler may take it
// that a value equals itself.
vec3 sfFiniteColor(vec3 color) {
  bvec3 is_nan = greaterThan(floatBitsToUint(color) & 0x7fffffffu, uvec3(0x7f800000u));
  return mix(clamp(color, 0.0, 65504.0), vec3(0.0), is_nan);
}

// What a scene shader writes for an sRGB-encoded data colour: one that a legend explains or somebody has chosen. No tone
// curve touches it. Alpha is opacity, and 1 where blending is off.
vec4 sfOutput(vec4 srgb) {
  vec3 color = sfFiniteColor(srgb.rgb);
  return u_linear_output > 0.5 ? vec4(sfLinearFromSrgb(color), srgb.a) : vec4(color, srgb.a);
}

// The same for an opaque lit or photographic colour, which exposure and tone mapping grade: in our target alpha is the
// share of a pixel's light that they leave alone.
vec4 sfGradedOutput(vec3 srgb) {
  vec3 color = sfFiniteColor(srgb);
  return u_linear_output > 0.5 ? vec4(sfLinearFromSrgb(color), 0.0) : vec4(color, 1.0);
}

// The same for a lit surface, in either state of setBlended(), which sets u_is_blended: what is translucent lies over the
// picture as a chosen colour does, ungraded.
uniform float u_is_blended = 0.0;
vec4 sfLitOutput(vec4 srgb) { return u_is_blended > 0.5 ? sfOutput(srgb) : sfGradedOutput(srgb.rgb); }

// Turns normals by a matrix with any scale: negative (normals stay outside), uneven, or zero along one axis.
mat3 sfNormalMatrix(mat3 m) {
  vec3 largest = max(max(abs(m[0]), abs(m[1])), abs(m[2]));
  m /= max(max(largest.x, max(largest.y, largest.z)), 1e-30);
  mat3 cofactors = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
  return dot(m[0], cofactors[0]) < 0.0 ? -cofactors : cofactors;
}

// The light on a surface whose normal and lamp have this cosine, a factor for its sRGB-encoded colour.
float sfShade(float cosine) { return 0.4 + 0.6 * clamp(cosine, 0.0, 1.0); }

// The light on a surface, a factor for its sRGB-encoded colour: a lamp at the eye, and a sky above the picture. A surface
// that faces the eye keeps its colour. Two-sided: the side that is seen is the one that is lit.
float sfLight(vec3 normal_in_eye, vec3 position_in_eye, bool is_two_sided) {
  bool is_orthographic = gl_ProjectionMatrix[3][3] == 1.0;
  vec3 to_eye = is_orthographic ? vec3(0.0, 0.0, 1.0) : normalize(-position_in_eye);
  float size = length(normal_in_eye);
  vec3 normal = size > 0.0 ? normal_in_eye / size : to_eye;
  float facing = dot(normal, to_eye);
  if (is_two_sided && facing < 0.0) {
    normal = -normal;
    facing = -facing;
  }
  return min(sfShade(facing) + 0.12 * normal.y * (1.0 - abs(facing)), 1.0);
}
