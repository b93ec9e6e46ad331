#include "scenegraph/raster/point_blocks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenegraph/raster/background_tasks.h"

namespace stillframe::scenegraph {
namespace {

constexpr std::size_t kLanes = 12;  // four points: a whole number of vectors

glm::dvec4 rowOf(const glm::dmat4& matrix, glm::length_t row) {
  return {matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row]};
}

PointBox boxOf(const float* values, std::size_t count) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  std::array<float, kLanes> low;
  std::array<float, kLanes> high;
  low.fill(kInfinity);
  high.fill(-kInfinity);
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const float value = values[i + lane];
      low[lane] = value < low[lane] ? value : low[lane];  // false for NaN
      high[lane] = value > high[lane] ? value : high[lane];
    }
  }
  for (std::size_t lane = 0; i + lane < count; ++lane) {
    const float value = values[i + lane];
    low[lane] = value < low[lane] ? value : low[lane];
    high[lane] = value > high[lane] ? value : high[lane];
  }
  PointBox box{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min({low[axis], low[axis + 3], low[axis + 6], low[axis + 9]});
    box.high[axis] = std::max({high[axis], high[axis + 3], high[axis + 6], high[axis + 9]});
  }
  return box;
}

}  // namespace

std::vector<PointBox> boxesOf(std::span<const float> positions) {
  constexpr std::size_t kFloats = std::size_t{3} * kPassesOfSample;
  constexpr std::size_t kGroupsATask = 256;  // as many as a part of convertCloud() has: those it finds by itself
  std::vector<PointBox> boxes((positions.size() + kFloats - 1) / kFloats);
  runInBackground((boxes.size() + kGroupsATask - 1) / kGroupsATask, [&](std::size_t task) {
    const std::size_t end = std::min((task + 1) * kGroupsATask, boxes.size());
    for (std::size_t group = task * kGroupsATask; group < end; ++group) {
      const std::size_t first = group * kFloats;
      boxes[group] = boxOf(&positions[first], std::min(kFloats, positions.size() - first));
    }
  });
  return boxes;
}

BoxCull::BoxCull(const glm::dmat4& clip_from_points) {
  const glm::dvec4 x = rowOf(clip_from_points, 0);
  const glm::dvec4 y = rowOf(clip_from_points, 1);
  const glm::dvec4 z = rowOf(clip_from_points, 2);
  const glm::dvec4 w = rowOf(clip_from_points, 3);
  planes_ = {w - x, w + x, w - y, w + y, z, w - z};
}

bool BoxCull::mayBeSeen(const PointBox& box) const noexcept {
  if (box.low[0] > box.high[0] || box.low[1] > box.high[1] || box.low[2] > box.high[2]) {
    return false;
  }
  // The projection sums up to eight products, each rounded to 24 bits, of terms this large.
  constexpr double kRounding = 16.0 * 0x1p-24;
  for (const glm::dvec4& plane : planes_) {
    double most = plane.w;
    double terms = std::abs(plane.w);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double factor = plane[static_cast<glm::length_t>(axis)];
      most += factor * static_cast<double>(factor > 0.0 ? box.high[axis] : box.low[axis]);
      terms += std::abs(factor) * static_cast<double>(std::max(std::abs(box.low[axis]), std::abs(box.high[axis])));
    }
    if (most < -kRounding * terms) {  // false for NaN
      return false;
    }
  }
  return true;
}

}  // namespace stillframe::scenegraph
