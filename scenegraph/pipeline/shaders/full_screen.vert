#version 450 compatibility
// One triangle over the whole viewport; gl_Vertex is in clip space.
void main() { gl_Position = vec4(gl_Vertex.xy, 0.0, 1.0); }
