#version 450 compatibility
#include "pass.glsl"
// u_image times u_gain through a curve, as far as its alpha lets (tone_map.h).
const int kAces = 1;
const int kNeutral = 2;
const float kAllData = 0.998;  // an alpha of 1 that was interpolated and rounded to a half float may be a little below

uniform sampler2D u_image;
uniform float u_gain;
uniform int u_curve;

// The ratio of two parabolas that K. Narkowicz fitted to the ACES curves.
vec3 acesLike(vec3 light) {
  return clamp(light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14), 0.0, 1.0);
}

// Khronos PBR Neutral: black lifted by the 4 % that a dielectric reflects is taken off, the peak is compressed towards
// 1 above 0.76, and what was compressed loses saturation.
vec3 pbrNeutral(vec3 light) {
  const float kReflected = 0.04;
  const float kStart = 0.8 - kReflected;
  const float kDesaturation = 0.15;
  float least = min(light.r, min(light.g, light.b));
  vec3 color = light - (least < 2.0 * kReflected ? least - least * least / (4.0 * kReflected) : kReflected);
  float peak = max(color.r, max(color.g, color.b));
  if (peak < kStart) {
    return color;
  }
  const float kRoom = 1.0 - kStart;
  float compressed = 1.0 - kRoom * kRoom / (peak + kRoom - kStart);
  float kept = 1.0 / (kDesaturation * (peak - compressed) + 1.0);
  return mix(vec3(compressed), color * (compressed / peak), kept);
}

void main() {
  vec4 color = sfColor(u_image, ivec2(gl_FragCoord.xy));
  vec3 light = color.rgb * u_gain;
  vec3 graded = u_curve == kAces ? acesLike(light) : u_curve == kNeutral ? pbrNeutral(light) : light;
  // Not mix(): a data colour is to come out bit for bit.
  gl_FragColor = sfFinite(vec4(color.a < kAllData ? graded + (color.rgb - graded) * color.a : color.rgb, color.a));
}
