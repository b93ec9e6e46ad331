// pass.glsl: shared by the post passes; the embed step puts it in place of the include line.
//
// Set by the pipeline: u_ray_scale, half the width and height of the view at distance 1 (perspective) or anywhere
// (orthographic), metres; u_distance, metres in front of the eye from reverse-Z depth: x / depth, or x + y * depth.
uniform vec2 u_ray_scale = vec2(1.0);
uniform vec2 u_distance = vec2(1.0, 0.0);
uniform bool u_is_orthographic = false;

const float kLargestHalf = 65504.0;

// NaN becomes 0, infinities and what a half float cannot hold its largest value, what is below zero 0. By bits: a
// compiler may take it that a value equals itself.
float sfFinite(float value) {
  return (floatBitsToUint(value) & 0x7fffffffu) > 0x7f800000u ? 0.0 : clamp(value, 0.0, kLargestHalf);
}
vec4 sfFinite(vec4 value) {
  return vec4(sfFinite(value.r), sfFinite(value.g), sfFinite(value.b), min(sfFinite(value.a), 1.0));
}

// The colour that an earlier pass, or the scene, has left there.
vec4 sfColor(sampler2D image, ivec2 place) { return sfFinite(texelFetch(image, place, 0)); }

// Metres in front of the eye. In perspective depth must be above 0, which is infinitely far away.
float sfDistance(float depth) { return u_is_orthographic ? u_distance.x + u_distance.y * depth : u_distance.x / depth; }

// Where the middle of a pixel lies in the eye's plane, in units of u_ray_scale's.
vec2 sfRay(ivec2 place, ivec2 size) { return ((vec2(place) + 0.5) / vec2(size) * 2.0 - 1.0) * u_ray_scale; }

// Position in eye space, metres.
vec3 sfEyePosition(vec2 ray, float distance_m) {
  return u_is_orthographic ? vec3(ray, -distance_m) : vec3(ray, -1.0) * distance_m;
}
