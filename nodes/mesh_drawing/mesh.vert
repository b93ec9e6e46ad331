#version 450 compatibility
#include "common.glsl"
// A mesh. In: gl_Vertex and gl_Normal in the mesh's own space, gl_Color (sRGB), a_uv with (0, 0) at the first texel.
layout(location = 7) in vec2 a_uv;
out vec3 v_normal_in_eye;
out vec3 v_position_in_eye;
out vec4 v_color;
out vec2 v_uv;

void main() {
  v_normal_in_eye = sfNormalMatrix(mat3(gl_ModelViewMatrix)) * gl_Normal;
  v_position_in_eye = vec3(gl_ModelViewMatrix * gl_Vertex);
  v_color = gl_Color;
  v_uv = a_uv;
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
