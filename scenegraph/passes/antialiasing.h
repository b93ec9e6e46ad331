#pragma once

#include "scenegraph/passes/effect.h"

namespace stillframe::scenegraph {

/// Smooth edges, three ways.
///
/// "fxaa": one pass over the finished picture that finds edges by contrast and shifts them by parts of a pixel; cheap,
/// and knows nothing of what lies between pixels. "msaa": the scene's target has several samples a pixel, so that
/// edges of geometry are smooth, textures and discarded fragments not; as many samples as the driver has at most.
/// "ssaa": the whole picture, passes and all, is drawn `samples` times, each moved by another part of a pixel, and
/// averaged; everything is smooth at `samples` times the cost. Sizes in pixels stay as they are in all of them.
struct AntialiasingSettings {
  std::string mode = "ssaa";
  std::int64_t samples = 4;  ///< of msaa and ssaa
};

[[nodiscard]] EffectType antialiasingEffect();
void appendAntialiasing(const AntialiasingSettings& settings, PostChain& chain);

}  // namespace stillframe::scenegraph
