#version 450
// Colours of the points of one cloud, where they are seen: scenegraph/raster/point_shading.h, whose tables these are. In:
// nearest and numbers of points_draw.comp; the cloud's arrays. Out: u_color, scene-linear; u_depth, reverse-Z, 0 where
// there are no points.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Positions { float positions[]; };
layout(std430, binding = 1) readonly buffer Values { float values[]; };
layout(std430, binding = 2) readonly buffer Colors { uint colors[]; };
layout(std430, binding = 3) readonly buffer Nearest { uint nearest[]; };
layout(std430, binding = 4) readonly buffer Numbers { uint numbers[]; };
layout(std430, binding = 5) readonly buffer Table { vec4 table[]; };
layout(std430, binding = 6) readonly buffer Bytes { float linear_of_byte[256]; };
layout(binding = 0, rgba16f) writeonly uniform image2D u_color;
layout(binding = 1, r32f) writeonly uniform image2D u_depth;
uniform ivec2 u_size_px;
uniform bool u_is_first;
uniform uvec2 u_numbers;  // of the points of the bound arrays: first and end
uniform int u_mode;
uniform int u_table_size;
uniform vec2 u_value;
uniform vec4 u_axis;
uniform vec3 u_flat;
uniform vec3 u_missing;
const int kRgb = 1;
const int kValue = 2;
const int kAxis = 3;

vec3 fromTable(float t) {
  float x = (t > 0.0 ? min(t, 1.0) : 0.0) * float(u_table_size - 1);
  int below = min(int(x), u_table_size - 2);
  return mix(table[below].rgb, table[below + 1].rgb, x - float(below));
}

void main() {
  int pixel = int((gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x);
  if (pixel >= u_size_px.x * u_size_px.y) {
    return;
  }
  ivec2 place = ivec2(pixel % u_size_px.x, pixel / u_size_px.x);
  uint depth = nearest[pixel];
  if (u_is_first) {
    imageStore(u_depth, place, vec4(uintBitsToFloat(depth)));
  }
  uint number = numbers[pixel];
  if (depth == 0u || number < u_numbers.x || number >= u_numbers.y) {
    return;
  }
  uint at = number - u_numbers.x;
  vec4 color = vec4(u_flat, 1.0);
  if (u_mode == kRgb) {
    uint bytes = colors[at];
    color = vec4(linear_of_byte[bytes & 255u], linear_of_byte[bytes >> 8 & 255u], linear_of_byte[bytes >> 16 & 255u], 0.0);
  } else if (u_mode == kValue) {
    float value = values[at];
    color.rgb = value < -2.9e38 ? u_missing : fromTable(value * u_value.x + u_value.y);
  } else if (u_mode == kAxis) {
    vec3 point = vec3(positions[3u * at], positions[3u * at + 1u], positions[3u * at + 2u]);
    color.rgb = fromTable(u_axis.x * point.x + u_axis.y * point.y + u_axis.z * point.z + u_axis.w);
  }
  imageStore(u_color, place, color);
}
