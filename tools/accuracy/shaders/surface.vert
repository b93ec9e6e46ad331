#version 450 compatibility
#include "common.glsl"
// Surfaces of the scene that the report of the passes measures. In: gl_Color, sRGB.
out vec4 v_color;
out vec3 v_normal_in_eye;

void main() {
  v_color = gl_Color;
  v_normal_in_eye = gl_NormalMatrix * gl_Normal;
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
  gl_PointSize = 3.0;
}
