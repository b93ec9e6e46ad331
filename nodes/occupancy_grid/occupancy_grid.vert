#version 450 compatibility
// A tile of an occupancy grid. In: gl_Vertex, metres in the grid; gl_MultiTexCoord0, cells of the tile.
out vec2 v_cell;

void main() {
  v_cell = gl_MultiTexCoord0.xy;
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
