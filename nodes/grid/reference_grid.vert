#version 450 compatibility
#include "common.glsl"
// Lines of the reference grid. In: gl_Vertex, metres in the fixed frame. Uniforms: u_color, sRGB-encoded; u_normal, of
// the plane that they lie on. Out: the plane in eye space, normal and distance.
uniform vec4 u_color;
uniform vec3 u_normal;
out vec4 v_color;
flat out vec4 v_plane;

void main() {
  v_color = sfOutput(u_color);
  vec3 normal = mat3(gl_ModelViewMatrix) * u_normal;
  v_plane = vec4(normal, dot(normal, (gl_ModelViewMatrix * gl_Vertex).xyz));
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
