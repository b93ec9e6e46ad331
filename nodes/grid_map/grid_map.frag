#version 450 compatibility
#include "common.glsl"
// A grid map, coloured by the cell beneath the fragment. In: v_cell, in cells from the map's corner; u_cells, a texel a
// cell: sRGB and alpha, or values that u_value maps to 0..1 over the range. The light stands fixed over the map.
const int kRgb = 1;
const int kValue = 2;
const float kMissing = -2.9e38;
const vec3 kLight = vec3(0.267, 0.358, 0.895);

uniform int u_color_mode;
uniform sampler2D u_cells;
uniform ivec2 u_cell_count;
uniform vec2 u_value;
uniform vec3 u_colormap[33];
uniform vec3 u_flat_color;
uniform vec3 u_missing_color;
uniform bool u_missing_is_hole;
uniform bool u_shading;
uniform float u_opacity;
in vec2 v_cell;
in vec3 v_normal;

vec3 mapped(float t) {
  float x = clamp(t, 0.0, 1.0) * 32.0;
  int below = min(int(x), 31);
  return mix(u_colormap[below], u_colormap[below + 1], x - float(below));
}

void main() {
  ivec2 cell = clamp(ivec2(floor(v_cell)), ivec2(0), u_cell_count - 1);
  vec4 color = vec4(u_flat_color, 1.0);
  if (u_color_mode == kRgb) {
    color = texelFetch(u_cells, cell, 0);
  } else if (u_color_mode == kValue) {
    float value = texelFetch(u_cells, cell, 0).r;
    if (value < kMissing && u_missing_is_hole) {
      discard;
    }
    color.rgb = value < kMissing ? u_missing_color : mapped(value * u_value.x + u_value.y);
  }
  color.a *= u_opacity;
  if (color.a <= 0.0) {
    discard;
  }
  if (u_shading) {
    color.rgb *= sfShade(dot(normalize(v_normal), kLight));
  }
  gl_FragColor = sfOutput(color);
}
