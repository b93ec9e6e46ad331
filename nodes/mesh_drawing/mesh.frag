#version 450 compatibility
#include "common.glsl"
// A mesh, both sides lit from the eye. In: v_color times u_color, sRGB-encoded, times the texture where there is one; texels that are
// more transparent than not are holes.
uniform vec4 u_color;
uniform float u_opacity;
uniform bool u_is_textured;
uniform sampler2D u_texture;
in vec3 v_normal_in_eye;
in vec3 v_position_in_eye;
in vec4 v_color;
in vec2 v_uv;

void main() {
  vec4 color = v_color * u_color;
  if (u_is_textured) {
    vec4 texel = texture(u_texture, v_uv);
    if (texel.a < 0.5) {
      discard;
    }
    color.rgb *= texel.rgb;
  }
  color.a *= u_opacity;
  if (color.a <= 0.0) {
    discard;
  }
  gl_FragColor = sfLitOutput(vec4(color.rgb * sfLight(v_normal_in_eye, v_position_in_eye, true), color.a));
}
