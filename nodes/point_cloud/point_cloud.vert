#version 450 compatibility
#include "common.glsl"
#include "coloring.glsl"
// Points, one colour each. In: gl_Vertex, metres in the source frame less the cloud's origin; gl_Color, sRGB bytes of the
// point; a_value, the colour field less its offset. u_axis maps gl_Vertex to 0..1 over the range, computed in double on
// the CPU.
const int kRgb = 1;
const int kValue = 2;
const int kAxis = 3;

layout(location = 6) in float a_value;
uniform vec4 u_axis;
uniform float u_opacity;
uniform float u_point_size;
uniform bool u_size_in_metres;
flat out vec4 v_color;

void main() {
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
  float size_px = u_point_size * (u_size_in_metres ? 1.0 : u_pixel_ratio);
  if (u_size_in_metres) {
    size_px *= 0.5 * u_viewport_height_px * gl_ProjectionMatrix[1][1] / max(gl_Position.w, 1e-6);
  }
  gl_PointSize = clamp(size_px, 1.0, 255.0);  // what every driver can do

  vec3 color = u_flat_color;
  if (u_color_mode == kRgb) {
    color = gl_Color.rgb;
  } else if (u_color_mode == kValue) {
    color = sfValueColor(a_value);
  } else if (u_color_mode == kAxis) {
    color = sfMapped(dot(u_axis.xyz, gl_Vertex.xyz) + u_axis.w);
  }
  v_color = u_color_mode == kRgb && u_opacity >= 1.0 ? sfGradedOutput(color) : sfOutput(vec4(color, u_opacity));
}
