#pragma once

#include "scenegraph/passes/effect.h"

namespace stillframe::scenegraph {

/// Exposure and tone mapping of lit and photographic light. Data colours are not graded.
///
/// The alpha of the scene's target is the share of a pixel's light that is data: colours that a legend explains, or
/// that somebody has chosen. Data are what is flat: points, lines, texts, grids, cells and voxels, the axes of frames.
/// Lit are the surfaces of bodies: robots, meshes, and markers and poses that are solids or triangles; photographic the
/// colours of cameras on points. It composes by itself: an opaque data colour writes 1, a translucent one of either
/// sort is blended with (ONE, ONE_MINUS_SRC_ALPHA) in alpha; opaque lit and photographic colours write 0
/// (sfLitOutput(), sfGradedOutput() in common.glsl). What is graded is then mix(curve(light), light, alpha): a data
/// colour, over data or over the background, comes out as it went in, bit for bit, under every curve. A
/// translucent data colour over a graded surface gets its own share ungraded and the surface's share graded, the curve
/// being taken of the sum, which is the one thing here that is not exact.
///
/// Curves: "none" (exposure alone), "aces" (K. Narkowicz's fit of the ACES filmic curve, 2016), "neutral" (the Khronos
/// PBR Neutral tone mapper, 2024: below 0.8 it takes 0.04 off each channel, less where the least of them is below 0.08,
/// and does nothing else, so at no exposure is it the identity). All are monotone.
struct ToneMapSettings {
  std::string curve = "neutral";
  double exposure = 0.0;  ///< EV: each step doubles the light
};

[[nodiscard]] EffectType toneMapEffect();
void appendToneMap(const ToneMapSettings& settings, PostChain& chain);

}  // namespace stillframe::scenegraph
