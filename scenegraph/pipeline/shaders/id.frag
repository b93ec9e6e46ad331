
// Appended to a scene's fragment shader, whose main() has become sf_scene_main() and gl_FragColor sf_scene_color: writes
// the number of the drawable, the copy, the primitive and the vertex.
uniform uint u_id_drawable;
flat in ivec2 v_id;
out uvec4 sf_id;

void main() {
  sf_scene_main();
  if (!(sf_scene_color.a > 0.0)) {
    discard;
  }
  sf_id = uvec4(u_id_drawable, uint(v_id.x), uint(gl_PrimitiveID), uint(v_id.y));
}
