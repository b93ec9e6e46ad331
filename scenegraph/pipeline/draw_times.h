#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "scenegraph/scene.h"

namespace stillframe::scenegraph {

/// Milliseconds that each layer of a scene takes to draw by itself, in their order; nullopt for one that shows nothing.
///
/// Measured a frame a step, so that a window can answer meanwhile. Three frames are drawn for each layer with the nodes
/// of all others switched off, and three for none; of each the shortest counts, the GPU drained, and what a frame
/// without layers takes is taken off. Nothing that layers hold is touched, and between steps all is as it was. With the
/// context current, on its thread.
class DrawTimes {
 public:
  /// `scene` must outlive it.
  explicit DrawTimes(const Scene& scene);

  /// `draw` draws one frame of the scene. Does nothing more once isDone().
  void step(const std::function<void()>& draw);
  [[nodiscard]] bool isDone() const noexcept { return frames_ == kRepeats * (1 + shortest_ms_.size()); }
  [[nodiscard]] double share() const noexcept {
    return static_cast<double>(frames_) / static_cast<double>(kRepeats * (1 + shortest_ms_.size()));
  }
  /// False when layers have come or gone since, or their settings changed: the times are of nothing then.
  [[nodiscard]] bool isValid() const;
  [[nodiscard]] const std::vector<std::optional<double>>& times() const noexcept { return shortest_ms_; }

 private:
  static constexpr std::size_t kRepeats = 3;

  const Scene& scene_;
  std::uint64_t revision_ = 0;
  double without_layers_ms_ = 0.0;
  std::vector<std::optional<double>> shortest_ms_;
  std::size_t frames_ = 0;
};

}  // namespace stillframe::scenegraph
