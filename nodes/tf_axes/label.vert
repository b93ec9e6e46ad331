#version 450 compatibility
#include "common.glsl"
// Glyphs. In: gl_Vertex as osgText lays it out, gl_MultiTexCoord0 in the glyph texture, gl_Color sRGB-encoded.
out vec2 v_glyph;
out vec4 v_color;

void main() {
  v_glyph = gl_MultiTexCoord0.xy;
  v_color = sfOutput(gl_Color);
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
