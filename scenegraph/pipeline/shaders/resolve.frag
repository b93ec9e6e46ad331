#version 450 compatibility
#include "pass.glsl"
// Samples of a multisampled scene to its pixels: the mean of the colours, what is not finite counting as sfFinite says.
// Depth is that of the first sample, which lies at the same place in every pixel: planes stay planes.
uniform sampler2DMS u_colors;
uniform sampler2DMS u_depths;
uniform int u_samples;

void main() {
  ivec2 place = ivec2(gl_FragCoord.xy);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < u_samples; ++i) {
    sum += sfFinite(texelFetch(u_colors, place, i));
  }
  gl_FragColor = sum / float(u_samples);
  gl_FragDepth = texelFetch(u_depths, place, 0).r;
}
