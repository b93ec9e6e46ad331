#version 450 compatibility
#include "common.glsl"
#include "flat_depth.glsl"
// Colours of occupancy cells, and their depth among flat things. In: v_cell, cells of the tile. Uniforms: u_cells, the
// int8 values as bytes.
const int kCostmap = 1;
const int kRaw = 2;
const float kMostSamples = 4.0;

uniform sampler2D u_cells;
uniform int u_color_scheme;
uniform float u_alpha;
in vec2 v_cell;

// sRGB-encoded, alpha 0 or 1, of a byte 0..255.
vec4 cellColor(int value) {
  if (u_color_scheme == kRaw) {
    return vec4(vec3(float(value) / 255.0), 1.0);
  }
  if (value == 255) {
    return vec4(112.0, 137.0, 134.0, 255.0) / 255.0;
  }
  if (value > 127) {
    return vec4(1.0, float(value - 128) / 126.0, 0.0, 1.0);
  }
  if (value > 100) {
    return vec4(0.0, 1.0, 0.0, 1.0);
  }
  if (u_color_scheme == kCostmap) {
    if (value == 0) {
      return vec4(0.0);
    }
    if (value >= 99) {
      return value == 99 ? vec4(0.0, 1.0, 1.0, 1.0) : vec4(1.0, 0.0, 1.0, 1.0);
    }
    float cost = floor(2.55 * float(value) + 0.001) / 255.0;
    return vec4(cost, 0.0, 1.0 - cost, 1.0);
  }
  return vec4(vec3(1.0 - floor(2.55 * float(value) + 0.001) / 255.0), 1.0);
}

// Mean colour over the pixel: one cell when magnified, up to 4 x 4 samples when many cells fall on a pixel.
vec4 pixelColor() {
  ivec2 last = textureSize(u_cells, 0) - 1;
  vec2 across = dFdx(v_cell);
  vec2 up = dFdy(v_cell);
  float columns = clamp(ceil(length(across)), 1.0, kMostSamples);
  float rows = clamp(ceil(length(up)), 1.0, kMostSamples);
  vec4 sum = vec4(0.0);
  for (float j = 0.5; j < rows; j += 1.0) {
    for (float i = 0.5; i < columns; i += 1.0) {
      vec2 cell = v_cell + (i / columns - 0.5) * across + (j / rows - 0.5) * up;
      vec4 color = cellColor(int(255.0 * texelFetch(u_cells, clamp(ivec2(floor(cell)), ivec2(0), last), 0).r + 0.5));
      sum += vec4(color.rgb * color.a, color.a);
    }
  }
  return sum.a > 0.0 ? vec4(sum.rgb / sum.a, sum.a / (columns * rows)) : vec4(0.0);
}

void main() {
  vec4 color = pixelColor();
  color.a *= u_alpha;
  gl_FragDepth = sfFlatDepth();
  if (color.a <= 0.0) {
    discard;
  }
  gl_FragColor = sfOutput(color);
}
