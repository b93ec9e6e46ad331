#version 450 compatibility
// Glyphs. In: v_glyph, place in u_glyphs, whose alpha is coverage; v_color, as it is written.
uniform sampler2D u_glyphs;
in vec2 v_glyph;
in vec4 v_color;

void main() {
  gl_FragColor = vec4(v_color.rgb, v_color.a * texture(u_glyphs, v_glyph).a);
  if (!(gl_FragColor.a > 0.0)) {
    discard;  // quads reach beyond their glyphs; a plain viewer writes their depth
  }
}
