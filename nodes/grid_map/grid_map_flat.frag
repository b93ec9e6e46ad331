#version 450 compatibility
#include "common.glsl"
#include "coloring.glsl"
#include "flat_depth.glsl"
#include "grid_map.glsl"
// A grid map lying flat, among other flat things. A program of its own: one that writes depth cannot leave out hidden
// fragments beforehand.
void main() {
  gl_FragDepth = sfFlatDepth();
  gl_FragColor = sfMapColor();
}
