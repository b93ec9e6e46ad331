#version 450 compatibility
#include "pass.glsl"
// u_image at the 256 steps of sRGB bytes, scene-linear again: what is rounded after this stays as it is.
const float kHeight = 0.84;  // of the pattern, in steps; the rest is for what half floats round

uniform sampler2D u_image;

// Interleaved gradient noise (J. Jimenez, 2014): evenly spread over 0..1 in every small window.
float pattern(vec2 place) { return fract(52.9829189 * fract(dot(place, vec2(0.06711056, 0.00583715)))); }

void main() {
  vec4 color = sfColor(u_image, ivec2(gl_FragCoord.xy));
  vec3 linear = min(color.rgb, 1.0);
  vec3 srgb = mix(1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, linear * 12.92, lessThanEqual(linear, vec3(0.0031308)));
  vec2 place = gl_FragCoord.xy;
  vec3 noise = vec3(pattern(place), pattern(place + vec2(47.0, 17.0)), pattern(place + vec2(11.0, 71.0))) - 0.5;
  vec3 stepped = clamp(floor(255.0 * srgb + kHeight * noise + 0.5) / 255.0, 0.0, 1.0);
  vec3 low = stepped / 12.92;
  vec3 high = pow((stepped + 0.055) / 1.055, vec3(2.4));
  gl_FragColor = vec4(mix(high, low, lessThanEqual(stepped, vec3(0.04045))), color.a);
}
