#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scenegraph/objects/point_cloud.h"
#include "tools/sample/topic.h"

namespace stillframe::sample {

/// A spinning lidar of 32 rings, its points moved to the place the sensor has at the stamp. Every beam returns.
/// Immutable.
class Lidar {
 public:
  explicit Lidar(std::uint32_t points);
  /// The cloud of that instant: x, y, z, intensity, ring, time. Its bytes are written to `data`, which the cloud views.
  [[nodiscard]] scenegraph::PointCloud scan(const Stage& stage, std::int64_t elapsed_ns,
                                            std::vector<std::byte>& data) const;

 private:
  static constexpr std::uint32_t kRings = 32;
  void cast(const Stage& stage, std::int64_t elapsed_ns, std::span<std::byte> data) const;

  std::uint32_t points_;
  std::array<double, kRings> sines_{};
  std::array<double, kRings> cosines_{};
};

}  // namespace stillframe::sample
