#include "nodes/voxel_grid/voxel_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <utility>

namespace stillframe::nodes {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Where a ray, counted in cells, is within the grid.
struct Crossing {
  double enter = 0.0;
  double leave = kNever;
  int axis = -1;  ///< across whose border it comes in; -1: it begins within
};

std::optional<Crossing> crossing(const glm::dvec3& origin, const glm::dvec3& step, const glm::dvec3& count) {
  Crossing found;
  for (int axis = 0; axis < 3; ++axis) {
    if (step[axis] == 0.0) {
      if (!(origin[axis] >= 0.0 && origin[axis] <= count[axis])) {
        return std::nullopt;
      }
      continue;
    }
    const double a = -origin[axis] / step[axis];
    const double b = (count[axis] - origin[axis]) / step[axis];
    if (std::min(a, b) > found.enter) {
      found.enter = std::min(a, b);
      found.axis = axis;
    }
    found.leave = std::min(found.leave, std::max(a, b));
  }
  return found.enter < found.leave ? std::optional(found) : std::nullopt;
}

}  // namespace

VoxelRays::VoxelRays(std::shared_ptr<const VoxelBlock> block, std::string_view drawn_by, bool with_colors)
    : block_(std::move(block)),
      drawn_by_(block_->field(drawn_by)),
      colors_(with_colors ? block_->colors() : nullptr),
      list_(block_->list(drawn_by, with_colors)) {}

std::uint32_t VoxelRays::alphaOf(std::size_t voxel) const {
  const bool passes = drawn_by_ == nullptr || isDrawn(rawVoxel(drawn_by_->values.span(), drawn_by_->format, voxel),
                                                      drawn_by_->format, drawn_by_->limits, test_);
  return !passes ? 0U : colors_ == nullptr ? 255U : colors_->values.span()[voxel] >> 24U;
}

std::optional<std::uint32_t> VoxelRays::instanceOf(std::size_t voxel) const {
  if (!list_.values.words.valid() || list_.values.words->empty()) {
    return static_cast<std::uint32_t>(voxel);
  }
  const auto listed = list_.values.span();  // in increasing order
  const auto found = std::ranges::lower_bound(listed, static_cast<std::uint32_t>(voxel));
  return found != listed.end() && *found == voxel ? std::optional(static_cast<std::uint32_t>(found - listed.begin()))
                                                  : std::nullopt;
}

std::optional<VoxelRays::Hit> VoxelRays::meet(const scenegraph::PickRay& ray) const {
  const glm::dvec3& cell_size_m = block_->source().cell_size_m;
  const glm::dvec3 origin = ray.origin / cell_size_m;
  const glm::dvec3 step = ray.direction / cell_size_m;
  const glm::ivec3 count(block_->count());
  const auto within = is_seen_ ? crossing(origin, step, glm::dvec3(count)) : std::nullopt;
  if (!within || !std::isfinite(within->enter)) {
    return std::nullopt;
  }
  const glm::dvec3 start = origin + within->enter * step;
  glm::ivec3 cell(0);
  for (int axis = 0; axis < 3; ++axis) {
    const double border = step[axis] > 0.0 ? 0.0 : count[axis] - 1.0;
    const double at = axis == within->axis ? border : std::floor(start[axis]);
    cell[axis] = static_cast<int>(std::clamp(at, 0.0, count[axis] - 1.0));
  }
  const auto alphaAt = [&] {
    const auto row =
        static_cast<std::size_t>(cell.z) * static_cast<std::size_t>(count.y) + static_cast<std::size_t>(cell.y);
    const std::size_t voxel = row * static_cast<std::size_t>(count.x) + static_cast<std::size_t>(cell.x);
    return std::pair(voxel, alphaOf(voxel));
  };
  // No side of a voxel that the eye is in is seen, nor one that touches a voxel which hides it.
  std::uint32_t before = within->axis < 0 ? std::numeric_limits<std::uint32_t>::max() : 0U;
  double along = within->enter;
  for (;;) {
    const auto [voxel, alpha] = alphaAt();
    if (alpha > before) {
      const auto instance = instanceOf(voxel);
      return instance ? std::optional(Hit{*instance, along}) : std::nullopt;
    }
    before = alpha;
    glm::dvec3 next(kNever);  // where the ray leaves the cell across each axis; anew each time, so that nothing adds up
    for (int axis = 0; axis < 3; ++axis) {
      if (step[axis] != 0.0) {
        next[axis] = (cell[axis] + (step[axis] > 0.0 ? 1.0 : 0.0) - origin[axis]) / step[axis];
      }
    }
    const int axis = next.x <= next.y && next.x <= next.z ? 0 : next.y <= next.z ? 1 : 2;
    along = std::max(along, next[axis]);
    cell[axis] += step[axis] > 0.0 ? 1 : -1;
    if (cell[axis] < 0 || cell[axis] >= count[axis]) {
      return std::nullopt;
    }
  }
}

}  // namespace stillframe::nodes
