#pragma once

#include <glm/vec3.hpp>
#include <limits>
#include <span>

#include "tf/rigid_transform.h"

namespace stillframe::scenegraph {

/// A box along the axes of its frame, in double; empty until a point is added.
struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  [[nodiscard]] bool isValid() const noexcept { return low.x <= high.x && low.y <= high.y && low.z <= high.z; }
  void add(const glm::dvec3& point) noexcept;
  /// The middle; halves are added, so that no sum overflows.
  [[nodiscard]] glm::dvec3 centre() const noexcept { return low / 2.0 + high / 2.0; }
  [[nodiscard]] glm::dvec3 halfSize() const noexcept { return high / 2.0 - low / 2.0; }
  /// Corner 0..7: bit 0, 1 and 2 choose the high end of x, y and z.
  [[nodiscard]] glm::dvec3 corner(unsigned index) const noexcept;
};

/// The box round `box` seen from another frame; exact when that frame is not turned.
[[nodiscard]] Box transformBox(const tf::RigidTransform& target_from_source, const Box& box_in_source) noexcept;
/// `box`, widened to reach at least `radius_m` from its middle on every axis.
[[nodiscard]] Box atLeast(const Box& box, double radius_m) noexcept;

/// The box round those of `boxes` that lie together. Left out is what lies 100 times farther from the median of their
/// centres than all that lies nearer reaches, unless that is half of them or more: the origin of a map projection 500
/// km from its robot, a map beside the Earth's centre. Invalid boxes count for nothing. n log n.
[[nodiscard]] Box bulkOf(std::span<const Box> boxes);

}  // namespace stillframe::scenegraph
