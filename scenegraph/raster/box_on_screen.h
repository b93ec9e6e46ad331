#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "scenegraph/raster/point_blocks.h"

namespace stillframe::scenegraph {

/// Where in the picture the points of a box may fall.
struct BoxOnScreen {
  glm::dvec2 low_px;  ///< of their centres, unclamped
  glm::dvec2 high_px;
  double nearest = 0.0;  ///< reverse-Z depth that none of them exceeds
  double most_per_w = 0.0;

  /// How many points of a group a picture of it is worth, at most: two to four for each square of `size_px` that they
  /// may fall on (of as many places 86 to 98 % are met by chance). A power of two, up to kPassesOfSample.
  [[nodiscard]] std::uint32_t pointsWorthDrawing(double size_px) const noexcept;
};

/// Puts boxes of points into a picture: never too small, rounding of the points' own projection in floats included.
/// Some 50 ns a box.
class BoxProjector {
 public:
  BoxProjector(const glm::dmat4& clip_from_points, int width_px, int height_px);
  /// nullopt where the box reaches behind the eye, or cannot be judged.
  [[nodiscard]] std::optional<BoxOnScreen> project(const PointBox& box) const noexcept;

 private:
  glm::dmat4 clip_from_points_;
  glm::dvec2 half_size_px_;
};

}  // namespace stillframe::scenegraph
