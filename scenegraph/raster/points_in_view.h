#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "scenegraph/raster/box_on_screen.h"
#include "scenegraph/raster/point_raster.h"

namespace stillframe::scenegraph {

/// Points of the groups that may be seen, by the passes of the first lap that their group takes part in: what drawing
/// costs.
class PointsInView {
 public:
  /// Those of a batch in a picture of that size; all of them without boxes. Some 80 ns a group, in parallel.
  void add(const PointBatch& batch, int width_px, int height_px);

  [[nodiscard]] std::size_t count() const noexcept;
  /// How many of them the passes below `end` draw.
  [[nodiscard]] double drawnBefore(std::uint32_t end) const noexcept;
  /// The largest pass, from `first` to `end`, before which no more than `points` are drawn from `first` on.
  [[nodiscard]] std::uint32_t passesFor(double points, std::uint32_t first, std::uint32_t end) const noexcept;

  static constexpr std::size_t kSizes = 11;  ///< powers of two up to kPassesOfSample

 private:
  std::array<std::size_t, kSizes> by_size_{};
};

/// Of a group with this box, how many points are worth drawing in the first lap: all where that is not known.
[[nodiscard]] std::uint32_t pointsWorthDrawing(const PointBatch& batch, const std::optional<BoxOnScreen>& place);

}  // namespace stillframe::scenegraph
