#version 450 compatibility
// Points that the CPU has drawn. In: u_color, scene-linear; u_depth, reverse-Z, 0 where there are none.
uniform sampler2D u_color;
uniform sampler2D u_depth;

void main() {
  ivec2 place = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(u_depth, place, 0).r;
  if (depth <= 0.0) {
    discard;
  }
  gl_FragColor = texelFetch(u_color, place, 0);
  gl_FragDepth = depth;
}
