#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <string_view>

#include "tf/transform_buffer.h"

namespace stillframe::tf {

inline constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
inline constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();

inline RigidTransform translate(double x, double y, double z) { return {{1.0, 0.0, 0.0, 0.0}, {x, y, z}}; }

/// A turn about z, then an offset.
inline RigidTransform yaw(double angle, double x = 0.0, double y = 0.0, double z = 0.0) {
  return {{std::cos(angle / 2), 0.0, 0.0, std::sin(angle / 2)}, {x, y, z}};
}

inline TransformSample sample(std::string_view parent, std::string_view child, std::int64_t stamp_ns,
                              const RigidTransform& parent_from_child = {}, bool is_static = false) {
  return {parent, child, TimePoint{stamp_ns}, parent_from_child, is_static};
}

inline std::string numbered(std::string_view prefix, std::size_t number) {
  return std::string(prefix).append(std::to_string(number));
}

/// Uniform over all rotations; the translation's length is uniform in [min_offset, max_offset].
inline RigidTransform randomTransform(std::mt19937_64& random, double min_offset, double max_offset) {
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> length(min_offset, max_offset);
  const glm::dquat rotation(gauss(random), gauss(random), gauss(random), gauss(random));
  const glm::dvec3 direction(gauss(random), gauss(random), gauss(random));
  return {glm::normalize(rotation), glm::normalize(direction) * length(random)};
}

}  // namespace stillframe::tf
