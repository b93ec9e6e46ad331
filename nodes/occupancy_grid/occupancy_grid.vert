#version 450 compatibility
// A tile of an occupancy grid. In: gl_Vertex, metres in the grid; gl_MultiTexCoord0, cells of the tile.
out vec2 v_cell;
// How depth grows: x is 1 with the depth buffer reversed (near 1, far 0); y is 1 in perspective.
flat out ivec2 v_depth_kind;

void main() {
  v_cell = gl_MultiTexCoord0.xy;
  bool is_perspective = gl_ProjectionMatrix[2][3] != 0.0;
  float away = is_perspective ? gl_ProjectionMatrix[3][2] : gl_ProjectionMatrix[2][2];
  v_depth_kind = ivec2(away > 0.0 ? 1 : 0, is_perspective ? 1 : 0);
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
