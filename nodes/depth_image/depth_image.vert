#version 450 compatibility
#include "common.glsl"
#include "coloring.glsl"
// Pixels of a depth image as points. In: gl_Vertex, the pixel's ray in the optical frame (x, y, 1; z = 0: none), in units
// of 1 / u_unit metres; a_depth, metres along the axis, below zero for a hole; gl_Color, sRGB bytes of the pixel.
const int kRgb = 1;
const int kDepth = 2;

layout(location = 6) in float a_depth;
uniform float u_point_size;
uniform float u_max_depth;
uniform float u_unit;
flat out vec4 v_color;

void main() {
  bool is_drawn = a_depth > 0.0 && a_depth <= u_max_depth && gl_Vertex.z > 0.0;
  // What is not drawn goes outside the clip volume.
  gl_Position = is_drawn ? gl_ModelViewProjectionMatrix * vec4(gl_Vertex.xyz * (a_depth * u_unit), 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
  gl_PointSize = clamp(u_point_size * u_pixel_ratio, 1.0, 255.0);  // what every driver can do

  vec3 color = u_flat_color;
  if (u_color_mode == kRgb) {
    color = gl_Color.rgb;
  } else if (u_color_mode == kDepth) {
    color = sfValueColor(a_depth);
  }
  v_color = u_color_mode == kRgb ? sfGradedOutput(color) : sfOutput(vec4(color, 1.0));
}
