#version 450 compatibility
#include "pass.glsl"
// u_image darkened by the openness of its pixels, smoothed over the 4 x 4 texels round about that have the same turn
// only once. Texels of another depth have no say. u_divisor: pixels of the picture for one of u_openness.
uniform sampler2D u_image;
uniform sampler2D u_openness;
uniform sampler2D u_depth;
uniform float u_radius;
uniform int u_divisor;
uniform bool u_smooths;

float openness(ivec2 place, float distance_m) {
  ivec2 size = textureSize(u_depth, 0);
  ivec2 last = textureSize(u_openness, 0) - 1;
  ivec2 own = place / u_divisor;
  if (!u_smooths && u_divisor == 1) {
    return texelFetch(u_openness, own, 0).r;
  }
  ivec2 first = u_smooths ? ivec2(floor((vec2(place) + 0.5) / float(u_divisor) - 0.5)) - 1 : own;
  int count = u_smooths ? 4 : 2;
  float sum = 0.0;
  float weights = 0.0;
  for (int y = 0; y < count; ++y) {
    for (int x = 0; x < count; ++x) {
      ivec2 texel = clamp(first + ivec2(x, y), ivec2(0), last);
      float depth = texelFetch(u_depth, min(texel * u_divisor, size - 1), 0).r;
      if (depth > 0.0) {
        float weight = max(0.0, 1.0 - 4.0 * abs(sfDistance(depth) - distance_m) / u_radius);
        sum += weight * texelFetch(u_openness, texel, 0).r;
        weights += weight;
      }
    }
  }
  return weights > 1e-3 ? sum / weights : texelFetch(u_openness, own, 0).r;
}

void main() {
  ivec2 place = ivec2(gl_FragCoord.xy);
  vec4 color = sfColor(u_image, place);
  float depth = texelFetch(u_depth, place, 0).r;
  gl_FragColor = depth > 0.0 ? vec4(color.rgb * openness(place, sfDistance(depth)), color.a) : color;
}
