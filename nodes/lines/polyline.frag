#version 450 compatibility
#include "common.glsl"
#include "coloring.glsl"
// Segments of lines. A fragment belongs to the segment when it is within the radius of it, and not within that of the
// segment before: joints are round, without gaps, and blended once. In: what polyline.vert puts out. Along the
// segment colours and values go by the distance in space, not on the screen.
const int kValues = 2;
const float kMargin = 0.02;  // px; the rectangle's edges decide, by the rules of rasterisation

uniform float u_opacity;
in vec2 v_place;
flat in vec2 v_end;
flat in vec2 v_before;
flat in vec4 v_radii;
flat in vec2 v_depths;
flat in vec4 v_start_color;
flat in vec4 v_end_color;
flat in vec2 v_values;

// Where along the way from `from` the nearest point to `place` is.
float nearest(vec2 place, vec2 from, vec2 way) {
  float square = dot(way, way);
  return square > 0.0 ? dot(place - from, way) / square : 0.0;
}

void main() {
  float t = clamp(nearest(v_place, vec2(0.0), v_end), 0.0, 1.0);
  if (distance(v_place, t * v_end) > mix(v_radii.x, v_radii.y, t) + kMargin) {
    discard;
  }
  if (v_radii.w > 0.5) {
    float s = nearest(v_place, v_before, -v_before);
    bool is_past_start = s >= 0.0 || v_radii.w < 1.5;
    s = clamp(s, 0.0, 1.0);
    if (is_past_start && distance(v_place, (1.0 - s) * v_before) < mix(v_radii.z, v_radii.x, s) - kMargin) {
      discard;
    }
  }
  float in_space = t * v_depths.x / mix(v_depths.y, v_depths.x, t);
  vec4 color = mix(v_start_color, v_end_color, in_space);
  if (u_color_mode == kValues) {
    bool is_missing = sfIsMissing(min(v_values.x, v_values.y));
    color = vec4(is_missing ? u_missing_color : sfValueColor(mix(v_values.x, v_values.y, in_space)), 1.0);
  }
  color.a *= u_opacity;
  gl_FragColor = sfOutput(color);
}
