#version 450 compatibility
// Sides of voxels. In: v_color, as it is written.
flat in vec4 v_color;

void main() { gl_FragColor = v_color; }
