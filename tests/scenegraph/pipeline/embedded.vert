#version 450 compatibility
// Read by geometry_test: the embed step keeps "quotes", \ and ; and puts common.glsl in place of the next line.
#include "common.glsl"
void main() { gl_Position = gl_Vertex; }
