#pragma once

#include "scenegraph/passes/effect.h"

namespace stillframe::scenegraph {

/// Eye-dome lighting: a pixel is darker the more its neighbours are nearer to the eye. Gives clouds, which have no
/// normals, their shape; edges get an outline.
///
/// The neighbours lie on a ring whose radius goes with the picture's height, and depth counts by its logarithm
/// (orthographic: in parts of the view's height), so that neither resolution nor scale changes the look. Each neighbour
/// counts up to a limit: no pixel falls below 1 / 4^strength of its light. Costs `neighbours` texel reads a pixel.
struct EdlSettings {
  double strength = 1.0;
  double radius = 2.0;  ///< pixels of a picture 1080 high
  std::int64_t neighbours = 8;
};

[[nodiscard]] EffectType edlEffect();
void appendEdl(const EdlSettings& settings, PostChain& chain);

}  // namespace stillframe::scenegraph
