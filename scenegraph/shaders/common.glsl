// common.glsl: shared by every scene shader; the embed step puts it in place of the include line.
//
// u_linear_output (set by our view pipeline only): 1 when the target is scene-linear, 0 (the default, and so in an
// exported file in a stock viewer) when it shows what is written.
// u_viewport_height_px: height of the target, for sizes in metres; 720 where nobody sets it.
uniform float u_linear_output = 0.0;
uniform float u_viewport_height_px = 720.0;

// Exact sRGB decoding (IEC 61966-2-1).
vec3 sfLinearFromSrgb(vec3 srgb) {
  vec3 low = srgb / 12.92;
  vec3 high = pow((max(srgb, vec3(0.0)) + 0.055) / 1.055, vec3(2.4));
  return mix(high, low, lessThanEqual(srgb, vec3(0.04045)));
}

// What a scene shader writes for an sRGB-encoded colour.
vec4 sfOutput(vec4 srgb) {
  return u_linear_output > 0.5 ? vec4(sfLinearFromSrgb(srgb.rgb), srgb.a) : srgb;
}
