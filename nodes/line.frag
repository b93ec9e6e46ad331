#version 450 compatibility
// Lines in one colour. In: v_color, as it is written.
in vec4 v_color;

void main() { gl_FragColor = v_color; }
