#version 450 compatibility
// Points, square or round. In: v_color, as it is written.
uniform bool u_round_points;
flat in vec4 v_color;

void main() {
  if (u_round_points) {
    vec2 from_centre = 2.0 * gl_PointCoord - 1.0;
    if (dot(from_centre, from_centre) > 1.0) {
      discard;
    }
  }
  gl_FragColor = v_color;
}
