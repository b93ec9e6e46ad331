#version 450 compatibility
// Scene-linear u_image to sRGB bytes of the output, pixel for pixel.
uniform sampler2D u_image;

// Exact sRGB encoding (IEC 61966-2-1).
vec3 srgbFromLinear(vec3 linear) {
  vec3 clamped = clamp(linear, 0.0, 1.0);
  vec3 high = 1.055 * pow(clamped, vec3(1.0 / 2.4)) - 0.055;
  return mix(high, clamped * 12.92, lessThanEqual(clamped, vec3(0.0031308)));
}

void main() { gl_FragColor = vec4(srgbFromLinear(texelFetch(u_image, ivec2(gl_FragCoord.xy), 0).rgb), 1.0); }
