#version 450 compatibility
#include "common.glsl"
#include "coloring.glsl"
#include "grid_map.glsl"
// A grid map with heights.
void main() { gl_FragColor = sfMapColor(); }
