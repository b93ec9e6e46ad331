#version 450 compatibility
#include "common.glsl"
// Lines in one colour. In: gl_Vertex, metres in the source frame. Uniform: u_color, sRGB-encoded.
uniform vec4 u_color;
out vec4 v_color;

void main() {
  v_color = sfOutput(u_color);
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
