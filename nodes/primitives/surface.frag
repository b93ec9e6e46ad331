#version 450 compatibility
#include "common.glsl"
// Triangles in colours of their own, lit from the eye on either side. In: v_color, sRGB-encoded; normal and position in
// eye space.
uniform float u_opacity;
in vec3 v_normal_in_eye;
in vec3 v_position_in_eye;
in vec4 v_color;

void main() {
  float light = sfLight(v_normal_in_eye, v_position_in_eye, true);
  gl_FragColor = sfLitOutput(vec4(v_color.rgb * light, v_color.a * u_opacity));
}
