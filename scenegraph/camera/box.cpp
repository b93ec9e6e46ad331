#include "scenegraph/camera/box.h"

#include <algorithm>
#include <glm/common.hpp>
#include <vector>

namespace stillframe::scenegraph {
namespace {

constexpr double kStrayReaches = 100.0;

double largest(const glm::dvec3& distances) noexcept { return std::max({distances.x, distances.y, distances.z}); }

/// Distance from `point` to the nearest and to the farthest place of a box, along the axis where it is largest.
double nearestTo(const glm::dvec3& point, const Box& box) noexcept {
  return largest(glm::abs(point - glm::clamp(point, box.low, box.high)));
}

double farthestFrom(const glm::dvec3& point, const Box& box) noexcept {
  return largest(glm::max(glm::abs(point - box.low), glm::abs(point - box.high)));
}

}  // namespace

void Box::add(const glm::dvec3& point) noexcept {
  low = glm::min(low, point);
  high = glm::max(high, point);
}

glm::dvec3 Box::corner(unsigned index) const noexcept {
  return {(index & 1U) != 0 ? high.x : low.x, (index & 2U) != 0 ? high.y : low.y, (index & 4U) != 0 ? high.z : low.z};
}

Box transformBox(const tf::RigidTransform& target_from_source, const Box& box_in_source) noexcept {
  Box box_in_target;
  if (box_in_source.isValid()) {
    for (unsigned i = 0; i < 8; ++i) {
      box_in_target.add(tf::transformPoint(target_from_source, box_in_source.corner(i)));
    }
  }
  return box_in_target;
}

Box bulkOf(std::span<const Box> boxes) {
  std::vector<const Box*> valid;
  for (const Box& box : boxes) {
    if (box.isValid()) {
      valid.push_back(&box);
    }
  }
  if (valid.empty()) {
    return {};
  }
  glm::dvec3 middle{};
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    const auto median = valid.begin() + static_cast<std::ptrdiff_t>(valid.size() / 2);
    std::ranges::nth_element(valid, median, {}, [axis](const Box* box) { return box->centre()[axis]; });
    middle[axis] = (*median)->centre()[axis];
  }
  std::ranges::sort(valid, {}, [&middle](const Box* box) { return farthestFrom(middle, *box); });
  Box bulk;
  double reach_m = 0.0;
  for (std::size_t i = 0; i < valid.size(); ++i) {
    const Box& box = *valid[i];
    const bool is_minority = 2 * (valid.size() - i) < valid.size();
    if (is_minority && nearestTo(middle, box) > kStrayReaches * reach_m) {
      break;
    }
    bulk.add(box.low);
    bulk.add(box.high);
    reach_m = farthestFrom(middle, box);
  }
  return bulk;
}

Box atLeast(const Box& box, double radius_m) noexcept {
  if (!box.isValid()) {
    return box;
  }
  Box wide = box;
  wide.add(box.centre() - radius_m);
  wide.add(box.centre() + radius_m);
  return wide;
}

}  // namespace stillframe::scenegraph
