#version 450 compatibility
#include "common.glsl"
// Triads with a light at the eye. In: v_normal_in_eye, v_color sRGB-encoded.
in vec3 v_normal_in_eye;
in vec4 v_color;

void main() {
  float facing = abs(normalize(v_normal_in_eye).z);
  gl_FragColor = sfOutput(vec4(v_color.rgb * (0.7 + 0.3 * facing), v_color.a));
}
