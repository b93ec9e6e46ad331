
// Appended to a scene's vertex shader, whose main() has become sf_scene_main(): says which vertex and copy this is, and
// drops points that do not touch the window about the cursor. Clip space.
uniform vec4 u_id_window;
uniform vec2 u_id_pixel;
uniform bool u_id_is_point;
flat out ivec2 v_id;

void main() {
  sf_scene_main();
  v_id = ivec2(gl_InstanceID, gl_VertexID);
  if (u_id_is_point) {
    vec2 at = gl_Position.xy / gl_Position.w;
    vec2 reach = (0.5 * gl_PointSize + 1.0) * u_id_pixel;
    if (any(lessThan(at + reach, u_id_window.xy)) || any(greaterThan(at - reach, u_id_window.zw))) {
      gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    }
  }
}
