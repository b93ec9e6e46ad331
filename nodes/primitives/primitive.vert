#version 450 compatibility
#include "common.glsl"
#include "instances.glsl"
// Copies of a mesh. In: gl_Vertex and gl_Normal of the mesh; u_instances, four texels a copy: three rows of the matrix
// that places the mesh, then 0xrrggbb as a number (sRGB), alpha, taper, id. Taper t shrinks the end z = 0.5 of the mesh
// to t below 1, and the end z = -0.5 to 2 - t above it. u_faces_viewer: a square in the
// plane of the picture instead, unlit.
uniform samplerBuffer u_instances;
uniform bool u_faces_viewer;
out vec3 v_normal_in_eye;
out vec3 v_position_in_eye;
flat out vec4 v_color;
flat out int v_is_mirrored;

void main() {
  int at = 4 * sfInstance();
  vec4 x = texelFetch(u_instances, at);
  vec4 y = texelFetch(u_instances, at + 1);
  vec4 z = texelFetch(u_instances, at + 2);
  vec4 look = texelFetch(u_instances, at + 3);
  uint rgb = uint(look.x);
  v_color = vec4(vec3((rgb >> 16) & 255u, (rgb >> 8) & 255u, rgb & 255u) / 255.0, look.y);

  float bottom = min(2.0 - look.z, 1.0);
  float top = min(look.z, 1.0);
  vec3 position = gl_Vertex.xyz;
  position.xy *= mix(bottom, top, position.z + 0.5);
  vec3 normal = gl_Normal;
  if (look.z != 1.0 && abs(normal.z) < 0.5) {
    normal.z = 0.5 * (bottom - top);
  }
  mat3 local_from_mesh = transpose(mat3(x.xyz, y.xyz, z.xyz));
  vec4 local = vec4(local_from_mesh * position + vec3(x.w, y.w, z.w), 1.0);
  v_is_mirrored = determinant(local_from_mesh) < 0.0 ? 1 : 0;
  v_normal_in_eye = gl_NormalMatrix * (sfNormalMatrix(local_from_mesh) * normal);
  v_position_in_eye = vec3(gl_ModelViewMatrix * local);
  if (u_faces_viewer) {
    v_is_mirrored = 0;
    v_normal_in_eye = vec3(0.0);
    v_position_in_eye = vec3(gl_ModelViewMatrix * vec4(x.w, y.w, z.w, 1.0));
    v_position_in_eye.xy += abs(vec2(x.x, y.y)) * gl_Vertex.xy;
    gl_Position = look.y > 0.0 ? gl_ProjectionMatrix * vec4(v_position_in_eye, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  // What is wholly transparent lies outside of every picture.
  gl_Position = look.y > 0.0 ? gl_ModelViewProjectionMatrix * local : vec4(2.0, 2.0, 2.0, 1.0);
}
