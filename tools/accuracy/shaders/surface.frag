#version 450 compatibility
#include "common.glsl"
// Lit by a lamp at the eye. Uniforms: u_is_lit; u_light, how bright the lamp is.
uniform bool u_is_lit;
uniform float u_light;
in vec4 v_color;
in vec3 v_normal_in_eye;

void main() {
  float facing = u_is_lit ? u_light * (0.25 + 0.75 * abs(normalize(v_normal_in_eye).z)) : 1.0;
  gl_FragColor = vec4(sfOutput(v_color).rgb * facing, v_color.a);
}
