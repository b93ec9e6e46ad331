#ifdef SF_LISTED
#undef main
// Put after every fragment shader (makeProgram() does), and compiled where the pipeline defines SF_LISTED alone: what is
// blended is not drawn but kept, in a list for each sample, until transparency.frag has put the list in order. Images:
// the number of a sample's newest fragment, 0 for none; how many fragments there are; of each the number of the one
// before, its depth, and its colour, scene-linear, as four half floats. What writes a depth of its own is tested here, by
// the depth of what is opaque, which OpenGL would do too late; with several samples to a pixel SF_SAMPLED is defined.
#if !defined(SF_OWN_DEPTH)
layout(early_fragment_tests) in;
bool sfIsHidden() { return false; }
#elif defined(SF_SAMPLED)
layout(binding = 7) uniform sampler2DMS sf_depths;
bool sfIsHidden() { return !(gl_FragDepth > texelFetch(sf_depths, ivec2(gl_FragCoord.xy), gl_SampleID).r); }
#else
layout(binding = 7) uniform sampler2D sf_depths;
bool sfIsHidden() { return !(gl_FragDepth > texelFetch(sf_depths, ivec2(gl_FragCoord.xy), 0).r); }
#endif
layout(binding = 0, r32ui) uniform uimage2DArray sf_heads;
layout(binding = 1, r32ui) uniform uimage2D sf_count;
layout(binding = 2, rgba32ui) uniform writeonly uimage2D sf_fragments;

void main() {
  sfMain();
  // Above 0, by bits: a compiler may take it that there is no NaN.
  if (floatBitsToUint(gl_FragColor.a) - 1u >= 0x7f800000u || sfIsHidden()) {
    return;
  }
#ifdef SF_OWN_DEPTH
  float depth = gl_FragDepth;
#else
  float depth = gl_FragCoord.z;
#endif
  vec4 color = vec4(gl_FragColor.rgb, min(gl_FragColor.a, 1.0));
  ivec2 size = imageSize(sf_fragments);
  uint i = imageAtomicAdd(sf_count, ivec2(0), 1u);
  if (i < uint(size.x * size.y)) {
    uint before = imageAtomicExchange(sf_heads, ivec3(gl_FragCoord.xy, gl_SampleID), i + 1u);
    imageStore(sf_fragments, ivec2(i % uint(size.x), i / uint(size.x)),
               uvec4(before, floatBitsToUint(depth), packHalf2x16(color.rg), packHalf2x16(color.ba)));
  }
}
#endif
