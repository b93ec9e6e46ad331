#version 450 compatibility
#include "common.glsl"
// Triangles in colours of their own. In: gl_Vertex, metres less the origin; gl_Normal there, or zero where they keep
// their colour; gl_Color, sRGB-encoded.
out vec3 v_normal_in_eye;
out vec3 v_position_in_eye;
out vec4 v_color;

void main() {
  v_color = gl_Color;
  v_normal_in_eye = gl_NormalMatrix * gl_Normal;
  v_position_in_eye = vec3(gl_ModelViewMatrix * gl_Vertex);
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
