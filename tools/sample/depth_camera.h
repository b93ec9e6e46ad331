#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "tools/sample/topic.h"

namespace stillframe::sample {

/// What one pixel of a depth camera sees.
struct CameraPixel {
  double depth_m = 0.0;   ///< along the optical axis, with the sensor's noise; 0 where nothing is within reach
  std::uint32_t rgb = 0;  ///< 0x00RRGGBB
};

/// A depth camera on the robot: where it looks and along which rays. Immutable.
class DepthCamera {
 public:
  /// `rays` in the optical frame with z = 1, one a pixel; `salt` tells the noise of cameras apart.
  DepthCamera(const tf::RigidTransform& base_from_optical, std::vector<glm::dvec3> rays, std::uint64_t salt)
      : base_from_optical_(base_from_optical), rays_(std::move(rays)), salt_(salt) {}

  [[nodiscard]] const std::vector<glm::dvec3>& rays() const noexcept { return rays_; }
  /// A pixel for each ray. Depth reaches from 0.3 m to 7 m; its noise grows as a stereo camera's does.
  [[nodiscard]] std::vector<CameraPixel> look(const Stage& stage, std::int64_t elapsed_ns) const;

 private:
  tf::RigidTransform base_from_optical_;
  std::vector<glm::dvec3> rays_;
  std::uint64_t salt_;
};

}  // namespace stillframe::sample
