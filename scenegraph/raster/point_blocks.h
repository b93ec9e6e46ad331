#pragma once

#include <array>
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "scenegraph/raster/sample_order.h"

namespace stillframe::scenegraph {

/// Box of the points of one group of sample_order.h; turned inside out where none of them is anywhere.
struct PointBox {
  std::array<float, 3> low;
  std::array<float, 3> high;
};

/// Boxes of the groups of a cloud, the last of which may be short. NaN widens no box. One pass over the positions, at
/// the speed of memory, in parallel; 24 bytes a group of 1024 points. Any thread.
[[nodiscard]] std::vector<PointBox> boxesOf(std::span<const float> positions);

/// Whether a box may hold something that is inside the clip volume (z from 0 to w): never wrong when false, rounding of
/// the points' own projection in floats included.
class BoxCull {
 public:
  explicit BoxCull(const glm::dmat4& clip_from_points);
  [[nodiscard]] bool mayBeSeen(const PointBox& box) const noexcept;

 private:
  /// Least at a point that is inside: x * point.x + y * point.y + z * point.z + w, not below zero.
  std::array<glm::dvec4, 6> planes_;
};

}  // namespace stillframe::scenegraph
