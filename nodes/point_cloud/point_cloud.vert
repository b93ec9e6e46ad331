#version 450 compatibility
#include "common.glsl"
// Points, one colour each. In: gl_Vertex, metres in the source frame less the cloud's origin; gl_Color, sRGB bytes of the
// point; a_value, the colour field less its offset. Uniforms: colours sRGB-encoded; u_axis maps gl_Vertex, u_value maps
// a_value to 0..1 over the range; all of that is computed in double on the CPU.
const int kRgb = 1;
const int kValue = 2;
const int kAxis = 3;
const float kMissing = -2.9e38;

layout(location = 6) in float a_value;
uniform int u_color_mode;
uniform vec4 u_axis;
uniform vec2 u_value;
uniform vec3 u_colormap[33];
uniform vec3 u_flat_color;
uniform vec3 u_missing_color;
uniform float u_opacity;
uniform float u_point_size;
uniform bool u_size_in_metres;
flat out vec4 v_color;

vec3 mapped(float t) {
  float x = clamp(t, 0.0, 1.0) * 32.0;
  int below = min(int(x), 31);
  return mix(u_colormap[below], u_colormap[below + 1], x - float(below));
}

void main() {
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
  float size_px = u_point_size;
  if (u_size_in_metres) {
    size_px *= 0.5 * u_viewport_height_px * gl_ProjectionMatrix[1][1] / max(gl_Position.w, 1e-6);
  }
  gl_PointSize = clamp(size_px, 1.0, 1024.0);

  vec3 color = u_flat_color;
  if (u_color_mode == kRgb) {
    color = gl_Color.rgb;
  } else if (u_color_mode == kValue) {
    color = a_value < kMissing ? u_missing_color : mapped(a_value * u_value.x + u_value.y);
  } else if (u_color_mode == kAxis) {
    color = mapped(dot(u_axis.xyz, gl_Vertex.xyz) + u_axis.w);
  }
  v_color = sfOutput(vec4(color, u_opacity));
}
