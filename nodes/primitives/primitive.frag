#version 450 compatibility
#include "common.glsl"
// Copies of a closed mesh, lit from the eye; of what is translucent, only the front is seen. In: v_color, sRGB-encoded; normal and position in eye space.
uniform float u_opacity;
in vec3 v_normal_in_eye;
in vec3 v_position_in_eye;
flat in vec4 v_color;
flat in int v_is_mirrored;

void main() {
  float alpha = v_color.a * u_opacity;
  if (alpha < 1.0 && gl_FrontFacing == (v_is_mirrored == 1)) {
    discard;
  }
  float light = sfLight(v_normal_in_eye, v_position_in_eye, true);
  gl_FragColor = sfLitOutput(vec4(v_color.rgb * light, alpha));
}
