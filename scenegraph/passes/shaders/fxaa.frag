#version 450 compatibility
#include "pass.glsl"
// u_image with its edges shifted by parts of a pixel, after the idea of T. Lottes' FXAA: an edge is where brightness
// changes; it is followed both ways to its ends, and the nearer the end, the more of the other side a pixel takes.
const float kLeastContrast = 0.03;    // of brightness; below that nobody sees steps
const float kRelativeContrast = 0.1;  // of the brightest neighbour
const int kLongestWay = 16;           // texels that an edge is followed

uniform sampler2D u_image;

vec4 colorAt(ivec2 place) { return sfColor(u_image, clamp(place, ivec2(0), textureSize(u_image, 0) - 1)); }

// About as bright as it looks, 0..1.
float brightness(ivec2 place) {
  return sqrt(dot(min(colorAt(place).rgb, 1.0), vec3(0.2126, 0.7152, 0.0722)));
}

// Texels from `place` along `way` to where the pair of rows beside the edge has another mean; negative when the mean
// grows there. `across`: to the other row.
float endOfEdge(ivec2 place, ivec2 across, ivec2 way, float mean, float tolerance) {
  for (int i = 1; i <= kLongestWay; ++i) {
    ivec2 there = place + i * way;
    float change = 0.5 * (brightness(there) + brightness(there + across)) - mean;
    if (abs(change) >= tolerance) {
      return change < 0.0 ? float(i) : -float(i);
    }
  }
  return float(kLongestWay + 1);
}

void main() {
  ivec2 place = ivec2(gl_FragCoord.xy);
  const ivec2 x = ivec2(1, 0);
  const ivec2 y = ivec2(0, 1);
  float middle = brightness(place);
  float left = brightness(place - x);
  float right = brightness(place + x);
  float below = brightness(place - y);
  float above = brightness(place + y);
  float brightest = max(middle, max(max(left, right), max(below, above)));
  float darkest = min(middle, min(min(left, right), min(below, above)));
  gl_FragColor = colorAt(place);
  if (brightest - darkest < max(kLeastContrast, kRelativeContrast * brightest)) {
    return;
  }
  float bend_y = abs(below + above - 2.0 * middle) * 2.0 + abs(brightness(place - x - y) + brightness(place - x + y) - 2.0 * left) +
                 abs(brightness(place + x - y) + brightness(place + x + y) - 2.0 * right);
  float bend_x = abs(left + right - 2.0 * middle) * 2.0 + abs(brightness(place - x - y) + brightness(place + x - y) - 2.0 * below) +
                 abs(brightness(place - x + y) + brightness(place + x + y) - 2.0 * above);
  bool is_level = bend_y >= bend_x;
  float before = is_level ? below : left;
  float after = is_level ? above : right;
  ivec2 across = is_level ? y : x;
  float other = after;
  if (abs(before - middle) >= abs(after - middle)) {
    across = -across;
    other = before;
  }
  float mean = 0.5 * (middle + other);
  float tolerance = 0.25 * abs(other - middle);
  ivec2 along = is_level ? x : y;
  float ahead = endOfEdge(place, across, along, mean, tolerance);
  float behind = endOfEdge(place, across, -along, mean, tolerance);
  float nearer = abs(ahead) < abs(behind) ? ahead : behind;
  // At the nearer end the edge leaves our row only if brightness there changes away from ours.
  bool leaves = abs(nearer) <= float(kLongestWay) && (nearer > 0.0) == (middle > mean);
  if (leaves) {
    float share = max(0.0, 0.5 - (abs(nearer) - 0.5) / (abs(ahead) + abs(behind) - 1.0));
    gl_FragColor = mix(gl_FragColor, colorAt(place + across), share);
  }
}
