#version 450 compatibility
// The blended fragments of a sample (listed.glsl), put in order and laid over each other: light, premultiplied, and how
// much of what lies behind it hides. The nearest u_most_sorted are exact, in rounds of kRound; what lies behind those
// counts by its mean. In order means by depth, then by colour: nothing hangs on who came first. What has both in
// common counts once. Depth is the nearest one's.
const int kRound = 16;
const float kNothing = 1.0 / 4096.0;

layout(binding = 0, r32ui) uniform readonly uimage2DArray sf_heads;
layout(binding = 2, rgba32ui) uniform readonly uimage2D sf_fragments;
uniform int u_most_sorted;

bool isBefore(uvec3 a, uvec3 b) {  // depth, reverse and not negative: its bits are in its order
  return a.x != b.x ? a.x > b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

uvec4 fragmentAt(uint number) {
  uint i = number - 1u;
  uint width = uint(imageSize(sf_fragments).x);
  return imageLoad(sf_fragments, ivec2(i % width, i / width));
}

vec4 colorOf(uvec3 key) { return vec4(unpackHalf2x16(key.y), unpackHalf2x16(key.z)); }

void main() {
  uint head = imageLoad(sf_heads, ivec3(gl_FragCoord.xy, gl_SampleID)).r;
  if (head == 0u) {
    discard;
  }
  vec3 light = vec3(0.0);
  float through = 1.0;
  uint nearest = 0u;
  uvec3 last = uvec3(0xffffffffu, 0u, 0u);  // before all, then the last in the picture
  bool is_whole = false;
  for (int done = 0; done < u_most_sorted && !is_whole && through > kNothing; done += kRound) {
    uvec3 kept[kRound];
    for (int i = 0; i < kRound; ++i) {
      kept[i] = uvec3(0u);
    }
    int most = min(kRound, u_most_sorted - done);
    int count = 0;
    is_whole = true;
    for (uint number = head; number != 0u;) {
      uvec4 fragment = fragmentAt(number);
      number = fragment.x;
      uvec3 key = fragment.yzw;
      if (!isBefore(last, key)) {
        continue;
      }
      bool is_kept = false;  // segments of a line lie on each other, and are one line
      for (int i = 0; i < kRound; ++i) {
        is_kept = is_kept || (i < count && kept[i] == key);
      }
      if (is_kept) {
        continue;
      }
      if (count == most) {
        is_whole = false;
        if (!isBefore(key, kept[most - 1])) {
          continue;
        }
      } else {
        ++count;
      }
      // Downwards through all of them, each step with the same index in every invocation: what is put off goes on.
      for (int i = 0; i < kRound; ++i) {
        uvec3 there = kept[i];
        bool is_here = i < count && (i == count - 1 || isBefore(key, there));
        kept[i] = is_here ? key : there;
        key = is_here ? there : key;
      }
    }
    nearest = max(nearest, kept[0].x);
    for (int i = 0; i < count; ++i) {
      vec4 color = colorOf(kept[i]);
      light += through * color.a * color.rgb;
      through *= 1.0 - color.a;
      last = kept[i];
    }
  }
  if (!is_whole && through > kNothing) {
    vec4 sum = vec4(0.0);
    float rest = 1.0;
    for (uint number = head; number != 0u;) {
      uvec4 fragment = fragmentAt(number);
      number = fragment.x;
      uvec3 key = fragment.yzw;
      if (!isBefore(last, key)) {
        continue;
      }
      nearest = max(nearest, key.x);
      vec4 color = colorOf(key);
      sum += vec4(color.rgb * color.a, color.a);
      rest *= 1.0 - color.a;
    }
    if (sum.a > 0.0) {
      light += through * (1.0 - rest) * sum.rgb / sum.a;
      through *= rest;
    }
  }
  gl_FragColor = vec4(light, 1.0 - through);
  gl_FragDepth = uintBitsToFloat(nearest);
}
