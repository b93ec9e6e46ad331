#version 450 compatibility
// A second file of the same target.
void main() { gl_FragColor = vec4(1.0); }
