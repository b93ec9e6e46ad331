// grid_map.glsl: a grid map, coloured by the cell beneath the fragment. In: v_cell, in cells from the map's corner;
// u_cells, a texel a cell: sRGB and alpha, or values. The light stands fixed over the map.
const int kRgb = 1;
const int kValue = 2;
const vec3 kLight = vec3(0.267, 0.358, 0.895);

uniform sampler2D u_cells;
uniform ivec2 u_cell_count;
uniform bool u_missing_is_hole;
uniform bool u_shading;
uniform float u_opacity;
in vec2 v_cell;
in vec3 v_normal;

// What is written for the fragment; discards holes.
vec4 sfMapColor() {
  ivec2 cell = clamp(ivec2(floor(v_cell)), ivec2(0), u_cell_count - 1);
  vec4 color = vec4(u_flat_color, 1.0);
  if (u_color_mode == kRgb) {
    color = texelFetch(u_cells, cell, 0);
  } else if (u_color_mode == kValue) {
    float value = texelFetch(u_cells, cell, 0).r;
    if (sfIsMissing(value) && u_missing_is_hole) {
      discard;
    }
    color.rgb = sfValueColor(value);
  }
  color.a *= u_opacity;
  if (color.a <= 0.0) {
    discard;
  }
  if (u_shading) {
    color.rgb *= sfShade(dot(normalize(v_normal), kLight));
  }
  return sfOutput(color);
}
