#version 450 compatibility
#include "pass.glsl"
// One frame's part in the mean of several, which the blending adds up. u_weight: 1 / frames.
uniform sampler2D u_image;
uniform float u_weight;

void main() { gl_FragColor = u_weight * sfColor(u_image, ivec2(gl_FragCoord.xy)); }
