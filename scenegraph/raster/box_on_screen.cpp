#include "scenegraph/raster/box_on_screen.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace stillframe::scenegraph {

std::uint32_t BoxOnScreen::pointsWorthDrawing(double size_px) const noexcept {
  constexpr double kPointsASquare = 4.0;
  const glm::dvec2 squares = (high_px - low_px) / std::max(1.0, size_px) + 1.0;  // a size that is no number is 1
  const double points = kPointsASquare * squares.x * squares.y;
  return points < kPassesOfSample ? std::bit_floor(static_cast<std::uint32_t>(points)) : kPassesOfSample;
}

BoxProjector::BoxProjector(const glm::dmat4& clip_from_points, int width_px, int height_px)
    : clip_from_points_(clip_from_points), half_size_px_(0.5 * width_px, 0.5 * height_px) {}

std::optional<BoxOnScreen> BoxProjector::project(const PointBox& box) const noexcept {
  const glm::dvec3 low(box.low[0], box.low[1], box.low[2]);
  const glm::dvec3 high(box.high[0], box.high[1], box.high[2]);
  const glm::dvec3 edges = high - low;
  const glm::dvec3 farthest = glm::max(glm::abs(low), glm::abs(high));
  const glm::dmat4& m = clip_from_points_;
  const glm::dvec4 corner = m * glm::dvec4(low, 1.0);
  const std::array<glm::dvec4, 3> along{m[0] * edges.x, m[1] * edges.y, m[2] * edges.z};
  // The projection sums up to eight products, each rounded to 24 bits, of terms this large.
  constexpr double kRounding = 16.0 * 0x1p-24;
  const glm::dvec4 error = kRounding * (glm::abs(m[0]) * farthest.x + glm::abs(m[1]) * farthest.y +
                                        glm::abs(m[2]) * farthest.z + glm::abs(m[3]));
  double least_w = std::numeric_limits<double>::infinity();
  glm::dvec3 least(std::numeric_limits<double>::infinity());
  glm::dvec3 most(-std::numeric_limits<double>::infinity());
  for (unsigned i = 0; i < 8; ++i) {
    glm::dvec4 clip = corner;
    for (unsigned axis = 0; axis < 3; ++axis) {
      clip += (i >> axis & 1U) != 0 ? along[axis] : glm::dvec4(0.0);
    }
    const glm::dvec3 at = glm::dvec3(clip) / clip.w;
    least_w = std::min(least_w, clip.w);
    least = glm::min(least, at);
    most = glm::max(most, at);
  }
  const double sure_w = least_w - error.w;
  // Of what is drawn x and y are at most w.
  const glm::dvec3 quotients(1.0, 1.0, std::max(most.z, 0.0));
  const glm::dvec3 off = (glm::dvec3(error) + quotients * error.w) / sure_w + kRounding * quotients;
  const bool is_finite = std::isfinite(least.x + least.y + least.z + most.x + most.y + most.z + off.x + off.y + off.z);
  if (!(sure_w > error.w) || !is_finite) {
    return std::nullopt;
  }
  constexpr double kSubpixel = 1.0 / 256.0;
  const glm::dvec2 low_px = (glm::dvec2(least) - glm::dvec2(off) + 1.0) * half_size_px_ - kSubpixel;
  const glm::dvec2 high_px = (glm::dvec2(most) + glm::dvec2(off) + 1.0) * half_size_px_ + kSubpixel;
  return BoxOnScreen{low_px, high_px, most.z + off.z, 1.0 / sure_w};
}

}  // namespace stillframe::scenegraph
