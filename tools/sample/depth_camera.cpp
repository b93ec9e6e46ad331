#include "tools/sample/depth_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tools/sample/random.h"

namespace stillframe::sample {
namespace {

constexpr double kNearest_m = 0.3;
constexpr double kFarthest_m = 7.0;

std::uint32_t packedRgb(const Hit& hit, double shade) {
  const glm::vec3 rgb = appearance(hit.material).rgb * hit.tint * static_cast<float>(shade);
  std::uint32_t packed = 0;
  for (glm::length_t i = 0; i < 3; ++i) {
    packed = packed << 8U | static_cast<std::uint32_t>(std::clamp(255.0F * rgb[i] + 0.5F, 0.0F, 255.0F));
  }
  return packed;
}

}  // namespace

std::vector<CameraPixel> DepthCamera::look(const Stage& stage, std::int64_t elapsed_ns) const {
  const tf::RigidTransform map_from_optical = toRigid(stage.robot.truth(elapsed_ns)) * base_from_optical_;
  const RayCaster caster(stage.world, static_cast<double>(elapsed_ns) * 1e-9, map_from_optical.translation);
  const glm::dmat4 rotation = tf::toMatrix({map_from_optical.rotation, glm::dvec3{0.0}});
  Random random(stage.seed ^ static_cast<std::uint64_t>(elapsed_ns + 1) * salt_);

  std::vector<CameraPixel> pixels;
  pixels.reserve(rays_.size());
  for (const glm::dvec3& ray : rays_) {
    const double stretch = glm::length(ray);
    const glm::dvec3 direction_in_map = glm::dvec3{rotation * glm::dvec4{ray / stretch, 0.0}};
    const auto hit = caster.cast(direction_in_map, kFarthest_m * stretch);
    CameraPixel& pixel = pixels.emplace_back();
    if (hit && hit->range_m >= kNearest_m * stretch) {
      const double depth = hit->range_m / stretch;
      pixel.depth_m = depth + 0.0015 * depth * depth * random.gaussian();
      const double facing = std::abs(glm::dot(direction_in_map, hit->normal_in_map));
      pixel.rgb = packedRgb(*hit, 0.55 + 0.45 * facing);
    }
  }
  return pixels;
}

}  // namespace stillframe::sample
