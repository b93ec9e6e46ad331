#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "scenegraph/scene.h"

namespace stillframe::scenegraph {

/// Milliseconds that each layer of `scene` takes to draw by itself, in their order; nullopt for one that shows nothing.
///
/// `draw` draws one frame of the scene. It is called three times for each layer with the nodes of all others switched
/// off, and three times for none; of each the shortest counts, the GPU drained, and what a frame without layers takes
/// is taken off. Nothing that layers hold is touched. With the context current, on its thread.
[[nodiscard]] std::vector<std::optional<double>> measureDrawTimes(const Scene& scene,
                                                                  const std::function<void()>& draw);

}  // namespace stillframe::scenegraph
