#version 450 compatibility
#include "pass.glsl"
// Openness of each pixel, 1 where nothing round about rises above its tangent plane. In: u_depth of the scene; u_radius
// in metres; u_divisor, pixels of the scene for one of ours.
const float kGoldenAngle = 2.39996323;
const float kLargestRadius = 0.25;   // of the picture's height: a surface before the eye costs no more than another
const float kSmallestRadius_px = 1.0;
const float kBias = 0.02;            // sine of an elevation that counts as flat
const float kGain = 3.0;             // so that the crease between two walls is about half as bright
const float kDepthStep = 6e-8;       // of a 32-bit float below 1
const float kLargestBend = 0.02;     // of a depth that goes on as a plane

uniform sampler2D u_depth;
uniform float u_radius;
uniform float u_intensity;
uniform int u_samples;
uniform int u_divisor;

// Change of depth from `place` to the next texel along `axis`, on the side that goes on most like a plane.
float slopeAlong(ivec2 axis, ivec2 place, ivec2 size, float depth) {
  float best = kLargestBend * depth;
  float slope = 0.0;
  for (int side = -1; side <= 1; side += 2) {
    ivec2 far_place = place + 2 * side * axis;
    if (all(greaterThanEqual(far_place, ivec2(0))) && all(lessThan(far_place, size))) {
      float one = texelFetch(u_depth, place + side * axis, 0).r;
      float two = texelFetch(u_depth, far_place, 0).r;
      float bend = abs(2.0 * one - two - depth);
      if (one > 0.0 && bend < best) {
        best = bend;
        slope = float(side) * (one - depth);
      }
    }
  }
  return slope;
}

// Normal of the surface, towards the eye. In perspective 1 / distance is affine in the ray for a plane, in an
// orthographic view the distance is affine in the place.
vec3 normalAt(ivec2 place, ivec2 size, vec2 ray, float depth) {
  vec2 slope = vec2(slopeAlong(ivec2(1, 0), place, size, depth), slopeAlong(ivec2(0, 1), place, size, depth));
  vec2 texel = 2.0 * u_ray_scale / vec2(size);
  if (u_is_orthographic) {
    return normalize(vec3(u_distance.y * slope / texel, 1.0));
  }
  vec2 gradient = slope / depth / texel;
  return normalize(vec3(-gradient, 1.0 - dot(gradient, ray)));
}

void main() {
  ivec2 size = textureSize(u_depth, 0);
  ivec2 own = ivec2(gl_FragCoord.xy);
  ivec2 place = min(own * u_divisor, size - 1);
  float depth = texelFetch(u_depth, place, 0).r;
  gl_FragColor = vec4(1.0);
  if (!(depth > 0.0)) {
    return;
  }
  vec2 ray = sfRay(place, size);
  float distance_m = sfDistance(depth);
  float pixel_m = 2.0 * u_ray_scale.y / float(size.y) * (u_is_orthographic ? 1.0 : distance_m);
  float radius_px = min(u_radius / pixel_m, kLargestRadius * float(size.y));
  if (!(radius_px > kSmallestRadius_px)) {
    return;
  }
  float radius_m = radius_px * pixel_m;
  vec3 position = sfEyePosition(ray, distance_m);
  vec3 normal = normalAt(place, size, ray, depth);
  // What depth cannot tell apart is no elevation.
  float bias = kBias + (u_is_orthographic ? 8.0 * kDepthStep * abs(u_distance.y) / pixel_m : 0.0);
  // 4 x 4 pixels turn the pattern by different angles; smoothing takes their mean.
  ivec2 tile = own & 3;
  float turn = float((tile.x * 4 + tile.y) * 7 % 16) / 16.0 * kGoldenAngle;
  float taken = 0.0;
  for (int i = 0; i < u_samples; ++i) {
    float angle = float(i) * kGoldenAngle + turn;
    float reach = radius_px * sqrt((float(i) + 0.5) / float(u_samples));
    ivec2 other = place + ivec2(round(reach * vec2(cos(angle), sin(angle))));
    if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, size))) {
      continue;
    }
    float other_depth = texelFetch(u_depth, other, 0).r;
    if (!(other_depth > 0.0)) {
      continue;
    }
    vec3 way = (sfEyePosition(sfRay(other, size), sfDistance(other_depth)) - position) / radius_m;
    float squared = dot(way, way);
    if (squared < 1.0 && squared > 1e-12) {
      taken += max(0.0, dot(way, normal) * inversesqrt(squared) - bias) * (1.0 - squared);
    }
  }
  float fade = clamp(radius_px - kSmallestRadius_px, 0.0, 1.0);
  gl_FragColor.r = sfFinite(clamp(1.0 - fade * u_intensity * kGain * taken / float(u_samples), 0.0, 1.0));
}
