#include "scenegraph/passes/dither.h"

#include "generated/stillframe_passes/shaders.h"

namespace stillframe::scenegraph {

namespace glsl = shaders::stillframe_passes;

EffectType ditherEffect() {
  return makeEffectType<DitherSettings>(
      {.name = "dither", .label = "Dithering", .help = "Takes the bands out of slow gradients", .is_for_display = true},
      {}, appendDither);
}

void appendDither(const DitherSettings& /*settings*/, PostChain& chain) {
  const std::string color = chain.color();
  chain.passes.push_back({.name = "dither", .fragment_source = glsl::k_dither_frag, .inputs = {{"u_image", color}}});
}

}  // namespace stillframe::scenegraph
