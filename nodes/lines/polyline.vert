#version 450 compatibility
#include "common.glsl"
#include "coloring.glsl"
#include "instances.glsl"
// Segments of lines as rectangles on the screen, four vertices each, u_batch segments an instance. gl_Vertex only
// carries the bound. In: u_points, metres in the source frame less the origin, and w = 4 * style + flags (1: the segment
// that ends here is drawn, 2: a joint); u_styles, width and 1 when it is in metres; u_colors, sRGB; u_values. A segment
// is cut to what can be seen, in clip space, before it is divided: points behind the camera have no place on the screen.
// Out: pixels relative to the start of the segment, which is what the fragments measure.
const int kDrawn = 1;
const int kRound = 2;
const int kColors = 1;
const int kValues = 2;
const float kGuard = 8.0;  // cut this many half screens from the middle, so that pixels stay exact in float
const vec4 kNowhere = vec4(2.0, 2.0, 2.0, 1.0);

uniform samplerBuffer u_points;
uniform samplerBuffer u_styles;
uniform samplerBuffer u_colors;
uniform samplerBuffer u_values;
uniform int u_batch;
uniform int u_point_count;
uniform float u_depth_pull;  // half widths
uniform bool u_blends;  // opaque lines may cover their joints twice

out vec2 v_place;        // px from the start
flat out vec2 v_end;     // px from the start
flat out vec2 v_before;  // start of the segment before, px from the start
flat out vec4 v_radii;   // px: start, end, of the segment before its start; w: 0 none before, 1 its start is round, 2 not
flat out vec2 v_depths;  // clip w of start and end
flat out vec4 v_start_color;  // sRGB
flat out vec4 v_end_color;
flat out vec2 v_values;

// Part of a..b that can be seen, as parameters; x > y when there is none. Near and far are planes of either range of
// depth, for one of the two does not cut.
vec2 visiblePart(vec4 a, vec4 b) {
  vec3 bound_a = vec3(kGuard, kGuard, 1.0) * a.w;
  vec3 bound_b = vec3(kGuard, kGuard, 1.0) * b.w;
  if (all(lessThanEqual(abs(a.xyz), bound_a)) && all(lessThanEqual(abs(b.xyz), bound_b))) {
    return vec2(0.0, 1.0);
  }
  vec3 from[2] = vec3[2](bound_a - a.xyz, bound_a + a.xyz);
  vec3 to[2] = vec3[2](bound_b - b.xyz, bound_b + b.xyz);
  vec2 part = vec2(0.0, 1.0);
  for (int side = 0; side < 2; ++side) {
    for (int axis = 0; axis < 3; ++axis) {
      float f = from[side][axis];
      float g = to[side][axis];
      if (f < 0.0 && g < 0.0) {
        return vec2(1.0, 0.0);
      }
      if (f < 0.0) {
        part.x = max(part.x, f / (f - g));
      } else if (g < 0.0) {
        part.y = min(part.y, f / (f - g));
      }
    }
  }
  return part;
}

// Depth of a point in clip space, nearer by so many pixels as wide as they are there.
float depthOf(vec4 point, float pull_px, float half_height_px) {
  float depth = point.z / point.w;
  if (pull_px > 0.0) {
    float pull = pull_px / (gl_ProjectionMatrix[1][1] * half_height_px);
    if (gl_ProjectionMatrix[2][3] != 0.0) {
      float away = point.w * (1.0 - min(pull, 0.5));
      depth = gl_ProjectionMatrix[3][2] / away - gl_ProjectionMatrix[2][2];
    } else {
      depth += gl_ProjectionMatrix[2][2] * pull;
    }
  }
  return clamp(depth, -1.0, 1.0);
}

void main() {
  gl_Position = kNowhere;
  v_place = v_end = v_before = v_depths = v_values = vec2(0.0);
  v_radii = v_start_color = v_end_color = vec4(0.0);

  int start = sfInstance() * u_batch + gl_VertexID / 4;
  if (start + 1 >= u_point_count) {
    return;
  }
  vec4 end_point = texelFetch(u_points, start + 1);
  int end_flags = int(end_point.w);
  if ((end_flags & kDrawn) == 0) {
    return;
  }
  vec4 start_point = texelFetch(u_points, start);
  int start_flags = int(start_point.w);
  vec4 a = gl_ModelViewProjectionMatrix * vec4(start_point.xyz, 1.0);
  vec4 b = gl_ModelViewProjectionMatrix * vec4(end_point.xyz, 1.0);
  vec2 part = visiblePart(a, b);
  if (part.x > part.y) {
    return;
  }
  bool is_start_cut = part.x > 0.0;
  bool is_end_cut = part.y < 1.0;
  vec4 whole_a = a;
  a = is_start_cut ? mix(whole_a, b, part.x) : a;
  b = is_end_cut ? mix(whole_a, b, part.y) : b;

  vec2 half_screen =
      0.5 * u_viewport_height_px * vec2(gl_ProjectionMatrix[1][1] / gl_ProjectionMatrix[0][0], 1.0);
  vec2 style = texelFetch(u_styles, end_flags / 4).xy;
  float scale = 0.5 * style.x * (style.y > 0.5 ? gl_ProjectionMatrix[1][1] * half_screen.y : u_pixel_ratio);
  bool is_in_metres = style.y > 0.5;
  float radius_a = clamp(is_in_metres ? scale / a.w : scale, 0.5, 8192.0);
  float radius_b = clamp(is_in_metres ? scale / b.w : scale, 0.5, 8192.0);

  vec2 at = a.xy / a.w * half_screen;
  vec2 way = b.xy / b.w * half_screen - at;
  float length_px = length(way);
  vec2 along = length_px > 1e-6 ? way / length_px : vec2(1.0, 0.0);
  bool is_start_round = (start_flags & kRound) != 0 && !is_start_cut;
  bool is_end_round = (end_flags & kRound) != 0 && !is_end_cut;

  v_end = way;
  v_radii.xy = vec2(radius_a, radius_b);
  v_depths = vec2(a.w, b.w);
  if (u_blends && (start_flags & (kDrawn | kRound)) == (kDrawn | kRound) && !is_start_cut) {
    vec4 point = texelFetch(u_points, start - 1);
    vec4 before = gl_ModelViewProjectionMatrix * vec4(point.xyz, 1.0);
    vec2 seen = visiblePart(before, a);
    if (seen.x <= seen.y) {
      before = seen.x > 0.0 ? mix(before, a, seen.x) : before;
      v_before = before.xy / before.w * half_screen - at;
      v_radii.z = clamp(is_in_metres ? scale / before.w : scale, 0.5, 8192.0);
      v_radii.w = (int(point.w) & kRound) != 0 && seen.x <= 0.0 ? 1.0 : 2.0;
    }
  }

  if (u_color_mode == kColors) {
    vec4 color_a = texelFetch(u_colors, start);
    vec4 color_b = texelFetch(u_colors, start + 1);
    v_start_color = mix(color_a, color_b, part.x);
    v_end_color = mix(color_a, color_b, part.y);
  } else {
    v_start_color = v_end_color = vec4(u_flat_color, 1.0);
  }
  if (u_color_mode == kValues) {
    float value_a = texelFetch(u_values, start).r;
    float value_b = texelFetch(u_values, start + 1).r;
    v_values = sfIsMissing(min(value_a, value_b))
                   ? vec2(-3e38)
                   : vec2(mix(value_a, value_b, part.x), mix(value_a, value_b, part.y));
  }

  int corner = gl_VertexID & 3;
  bool is_end = corner >= 2;
  float side = (corner & 1) == 0 ? -1.0 : 1.0;
  vec2 place = is_end ? way + along * (is_end_round ? radius_b : 0.0) : -along * (is_start_round ? radius_a : 0.0);
  place += side * max(radius_a, radius_b) * vec2(-along.y, along.x);
  v_place = place;
  float depth = depthOf(is_end ? b : a, u_depth_pull * (is_end ? radius_b : radius_a), half_screen.y);
  gl_Position = vec4((at + place) / half_screen, depth, 1.0);
}
