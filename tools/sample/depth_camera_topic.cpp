#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>

#include "tools/sample/random.h"
#include "tools/sample/topic.h"

namespace stillframe::sample {
namespace {

constexpr std::uint32_t kWidth = 160;
constexpr std::uint32_t kHeight = 120;
constexpr std::uint32_t kPointStep = 32;  // x, y, z, padding, rgb, padding: PCL's PointXYZRGB
constexpr double kFocal_px = 130.0;       // about 63 degrees across
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

/// A depth camera's coloured cloud at 5 Hz, organised in rows; NaN where nothing is within its reach.
class DepthCamera final : public Topic {
 public:
  explicit DepthCamera(const Stage& stage) : stage_(stage) {}
  std::string_view name() const override { return "/camera/points"; }
  Ros2Type type() const override { return pointCloud2Type(); }
  std::int64_t periodNs() const override { return 200'000'000; }

  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    using scenegraph::FieldType;
    std::vector<std::byte> data(std::size_t{kWidth} * kHeight * kPointStep);
    cast(elapsed_ns, data);
    scenegraph::PointCloud cloud;
    cloud.stamp = {stage_.start_ns + elapsed_ns};
    cloud.frame_id = "camera_optical_frame";
    cloud.width = kWidth;
    cloud.height = kHeight;
    cloud.point_step = kPointStep;
    cloud.row_step = kWidth * kPointStep;
    cloud.is_dense = false;
    cloud.fields = {{"x", 0, FieldType::Float32},
                    {"y", 4, FieldType::Float32},
                    {"z", 8, FieldType::Float32},
                    {"rgb", 16, FieldType::Float32}};
    cloud.data.bytes = data;
    return serializePointCloud2(cloud);
  }

 private:
  void cast(std::int64_t elapsed_ns, std::span<std::byte> data) const {
    const tf::RigidTransform map_from_optical =
        toRigid(stage_.robot.truth(elapsed_ns)) * baseFromCamera() * cameraFromOptical();
    const RayCaster caster(stage_.world, static_cast<double>(elapsed_ns) * 1e-9, map_from_optical.translation);
    const glm::dmat4 rotation = tf::toMatrix({map_from_optical.rotation, glm::dvec3{0.0}});
    Random random(stage_.seed ^ static_cast<std::uint64_t>(elapsed_ns + 1) * 0xE7037ED1A0B428DBULL);

    std::byte* point = data.data();
    for (std::uint32_t v = 0; v < kHeight; ++v) {
      for (std::uint32_t u = 0; u < kWidth; ++u, point += kPointStep) {
        const glm::dvec3 ray{(u + 0.5 - 0.5 * kWidth) / kFocal_px, (v + 0.5 - 0.5 * kHeight) / kFocal_px, 1.0};
        const double stretch = glm::length(ray);
        const glm::dvec3 direction_in_map = glm::dvec3{rotation * glm::dvec4{ray / stretch, 0.0}};
        const auto hit = caster.cast(direction_in_map, kFarthest_m * stretch);
        std::array<float, 3> position;
        std::uint32_t rgb = 0;
        if (hit && hit->range_m >= kNearest_m * stretch) {
          const double depth = hit->range_m / stretch;
          const double noisy = depth + 0.0015 * depth * depth * random.gaussian();  // grows as a stereo camera's does
          const glm::dvec3 place = ray * noisy;
          position = {static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(place.z)};
          const double facing = std::abs(glm::dot(direction_in_map, hit->normal_in_map));
          rgb = packedRgb(*hit, 0.55 + 0.45 * facing);
        } else {
          position.fill(std::numeric_limits<float>::quiet_NaN());
        }
        std::memcpy(point, position.data(), sizeof position);
        std::memcpy(point + 16, &rgb, sizeof rgb);
      }
    }
  }

  Stage stage_;
};

}  // namespace

std::unique_ptr<Topic> makeDepthCamera(const Stage& stage) { return std::make_unique<DepthCamera>(stage); }

}  // namespace stillframe::sample
