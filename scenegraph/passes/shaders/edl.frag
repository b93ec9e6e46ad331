#version 450 compatibility
#include "pass.glsl"
// u_image darkened where neighbours are nearer to the eye (edl.h). u_radius in pixels of a picture 1080 high.
const float kGain = 64.0;        // a neighbour nearer by 1 / 64 of the distance, roughly, counts fully
const float kOrthographicView = 1.0724;  // 1 / (2 tan 25 degrees): the distance that an orthographic view has in effect
const float kDepthStep = 6e-8;   // of a 32-bit float below 1
const float kTwoPi = 6.28318531;

uniform sampler2D u_image;
uniform sampler2D u_depth;
uniform float u_strength;
uniform float u_radius;
uniform int u_neighbours;

void main() {
  ivec2 place = ivec2(gl_FragCoord.xy);
  ivec2 size = textureSize(u_depth, 0);
  vec4 color = sfColor(u_image, place);
  gl_FragColor = color;
  float depth = texelFetch(u_depth, place, 0).r;
  if (!(depth > 0.0)) {
    return;
  }
  float radius_px = max(1.0, u_radius * float(size.y) / 1080.0);
  float view_m = 2.0 * u_ray_scale.y * kOrthographicView;
  float response = 0.0;
  for (int i = 0; i < u_neighbours; ++i) {
    float angle = kTwoPi * float(i) / float(u_neighbours);
    ivec2 other = clamp(place + ivec2(round(radius_px * vec2(cos(angle), sin(angle)))), ivec2(0), size - 1);
    float nearness = texelFetch(u_depth, other, 0).r;
    if (nearness > depth) {
      // log2 of the ratio of distances; in an orthographic view its first term, less what depth cannot tell apart.
      float nearer = u_is_orthographic
                         ? 1.4427 * abs(u_distance.y) / view_m * max(0.0, nearness - depth - 2.0 * kDepthStep)
                         : log2(nearness / depth);
      response += clamp(kGain * nearer, 0.0, 1.0);
    }
  }
  gl_FragColor.rgb = color.rgb * exp2(-2.0 * u_strength * response / float(u_neighbours));
}
