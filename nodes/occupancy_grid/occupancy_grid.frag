#version 450 compatibility
#include "common.glsl"
// Colours of occupancy cells, and their depth (grid_tiles.h says why). In: v_cell, cells of the tile. Uniforms: u_cells,
// the int8 values as bytes; u_depth_step, how many steps the grid lies behind lines in its plane.
const int kCostmap = 1;
const int kRaw = 2;
const float kMostSamples = 4.0;
const float kRelativeStep = 1e-3;
const float kAbsoluteStep = 2.5e-7;
const float kOrthographicStep = 2e-6;
const float kSlopePixels = 2.0;

uniform sampler2D u_cells;
uniform int u_color_scheme;
uniform float u_alpha;
uniform float u_depth_step;
in vec2 v_cell;
flat in ivec2 v_depth_kind;

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

// gl_FragCoord.z moved away from the eye. A line in the plane has the depth of its own middle in all the pixels that it
// covers: that is a pixel or two of the plane's slope away. The steps keep grids apart beyond what rounding can do. With
// q = 1 near and 0 far away either way round, q / (1 + step) keeps its order and never leaves the range; in perspective
// q goes with the reciprocal of the distance, so that the relative step is one of distance.
float steppedDepth() {
  bool is_reversed = v_depth_kind.x == 1;
  float q = is_reversed ? gl_FragCoord.z : 1.0 - gl_FragCoord.z;
  float slope = max(abs(dFdx(gl_FragCoord.z)), abs(dFdy(gl_FragCoord.z)));
  vec2 step_size = v_depth_kind.y == 1 ? vec2(kRelativeStep, kAbsoluteStep) : vec2(0.0, kOrthographicStep);
  q /= 1.0 + u_depth_step * step_size.x + (kSlopePixels * slope + u_depth_step * step_size.y) / max(q, 1e-12);
  return is_reversed ? q : 1.0 - q;
}

void main() {
  vec4 color = pixelColor();
  color.a *= u_alpha;
  gl_FragDepth = steppedDepth();
  if (color.a <= 0.0) {
    discard;
  }
  gl_FragColor = sfOutput(color);
}
