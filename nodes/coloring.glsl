// coloring.glsl: colours of a layer, all sRGB-encoded; nodes/coloring_state.h sets the uniforms.
//
// u_color_mode: what colours come from, the layer's own numbers. u_value: maps a value less its offset to 0..1 over the
// range, computed in double on the CPU. u_colormap: anchors of 0..1.
uniform int u_color_mode;
uniform vec2 u_value;
uniform vec3 u_colormap[33];
uniform vec3 u_flat_color;
uniform vec3 u_missing_color;

// What stands for NaN among values (kMissingValue of nodes/points/channel.h is below it).
bool sfIsMissing(float value) { return value < -2.9e38; }

// Colour of t over 0..1, clamped.
vec3 sfMapped(float t) {
  float x = clamp(t, 0.0, 1.0) * 32.0;
  int below = min(int(x), 31);
  return mix(u_colormap[below], u_colormap[below + 1], x - float(below));
}

// Colour of a value less its offset.
vec3 sfValueColor(float value) {
  return sfIsMissing(value) ? u_missing_color : sfMapped(value * u_value.x + u_value.y);
}
