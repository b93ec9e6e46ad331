#include "nodes/primitives/instance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace stillframe::nodes {
namespace {

constexpr double kReach = 1e18;  // products of two such still fit a float

double channel(float value) { return value >= 0.0F ? std::min(static_cast<double>(value), 1.0) : 0.0; }  // NaN is 0

}  // namespace

Instance makeInstance(const tf::RigidTransform& frame_from_mesh, const glm::dvec3& scale,
                      const glm::dvec3& origin_in_frame, const scenegraph::Color& color) {
  Instance instance;
  const glm::dmat3 rotation = glm::mat3_cast(frame_from_mesh.rotation);
  const glm::dvec3 offset = frame_from_mesh.translation - origin_in_frame;
  bool is_sound = true;
  std::array<double, 12> rows{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      const double value = column < 3 ? rotation[column][row] * scale[column] : offset[row];
      is_sound = is_sound && std::abs(value) <= kReach;  // false for NaN
      rows[std::size_t{4} * static_cast<std::size_t>(row) + static_cast<std::size_t>(column)] = value;
    }
  }
  if (is_sound) {
    std::ranges::transform(rows, instance.local_from_mesh.begin(), [](double v) { return static_cast<float>(v); });
  }
  const auto byte = [](float value) { return static_cast<std::uint32_t>(std::lround(255.0 * channel(value))); };
  instance.rgb = static_cast<float>((byte(color.r) << 16U) | (byte(color.g) << 8U) | byte(color.b));
  instance.alpha = is_sound ? static_cast<float>(channel(color.a)) : 0.0F;
  return instance;
}

}  // namespace stillframe::nodes
