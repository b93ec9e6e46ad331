#version 450 compatibility
// A grid map. In: gl_Vertex, metres in the map's own frame less its z origin; a_normal, its unit normal there.
layout(location = 7) in vec4 a_normal;
uniform vec2 u_cell_size;
out vec2 v_cell;
out vec3 v_normal;

void main() {
  v_cell = gl_Vertex.xy / u_cell_size;
  v_normal = a_normal.xyz;
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
