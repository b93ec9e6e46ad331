#pragma once

#include "scenegraph/passes/effect.h"

namespace stillframe::scenegraph {

/// Screen-space ambient occlusion: corners and creases are darker, for as little of the sky is seen from them.
///
/// For each pixel, places round about within `radius` in the world that rise above its tangent plane take light away,
/// by the sine of their elevation, less the further they are. The plane is that of the depth itself, which is affine in
/// the picture for a plane: a flat wall gets none at any angle. Costs `samples` texel reads a pixel (a quarter of them
/// at half resolution), and two targets.
struct SsaoSettings {
  double radius = 0.5;           ///< metres in the scene
  double intensity = 1.0;        ///< 1 is that of the estimate
  std::int64_t samples = 16;     ///< places looked at for each pixel
  bool half_resolution = false;  ///< estimate for one of four pixels
  bool smoothing = false;        ///< mean of 4 x 4 pixels of like depth, which share out their directions
};

[[nodiscard]] EffectType ssaoEffect();
void appendSsao(const SsaoSettings& settings, PostChain& chain);

}  // namespace stillframe::scenegraph
