#version 450 compatibility
#include "common.glsl"
// Triads with a light at the eye. In: gl_Vertex and gl_Normal in the frame, gl_Color sRGB-encoded.
out vec3 v_normal_in_eye;
out vec4 v_color;

void main() {
  v_normal_in_eye = gl_NormalMatrix * gl_Normal;
  v_color = gl_Color;
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
