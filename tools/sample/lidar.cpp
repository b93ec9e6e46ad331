#include "tools/sample/lidar.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numbers>

#include "tools/sample/random.h"

namespace stillframe::sample {
namespace {

constexpr std::uint32_t kPointStep = 22;  // packed, as velodyne drivers send it
constexpr double kLowest_rad = -0.5352;   // -30.67 and +10.67 degrees: the fan of an HDL-32E
constexpr double kHighest_rad = 0.1862;
constexpr double kRangeNoise_m = 0.008;
constexpr double kMaxRange_m = 100.0;

static_assert(std::endian::native == std::endian::little);  // points are copied into the message as they are in memory

}  // namespace

Lidar::Lidar(std::uint32_t points) : points_(points) {
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    const double elevation = kLowest_rad + (kHighest_rad - kLowest_rad) * ring / (kRings - 1);
    sines_[ring] = std::sin(elevation);
    cosines_[ring] = std::cos(elevation);
  }
}

scenegraph::PointCloud Lidar::scan(const Stage& stage, std::int64_t elapsed_ns, std::vector<std::byte>& data) const {
  using scenegraph::FieldType;
  data.assign(std::size_t{points_} * kPointStep, std::byte{0});
  cast(stage, elapsed_ns, data);
  scenegraph::PointCloud cloud;
  cloud.stamp = {stage.start_ns + elapsed_ns};
  cloud.frame_id = "lidar_link";
  cloud.width = points_;
  cloud.point_step = kPointStep;
  cloud.row_step = static_cast<std::uint32_t>(data.size());
  cloud.fields = {{"x", 0, FieldType::Float32},    {"y", 4, FieldType::Float32},
                  {"z", 8, FieldType::Float32},    {"intensity", 12, FieldType::Float32},
                  {"ring", 16, FieldType::Uint16}, {"time", 18, FieldType::Float32}};
  cloud.data.bytes = data;
  return cloud;
}

void Lidar::cast(const Stage& stage, std::int64_t elapsed_ns, std::span<std::byte> data) const {
  const tf::RigidTransform map_from_lidar = toRigid(stage.robot.truth(elapsed_ns)) * baseFromLidar();
  const RayCaster caster(stage.world, static_cast<double>(elapsed_ns) * 1e-9, map_from_lidar.translation);
  const double yaw = 2.0 * std::atan2(map_from_lidar.rotation.z, map_from_lidar.rotation.w);
  const double c = std::cos(yaw);
  const double s = std::sin(yaw);
  Random random(stage.seed ^ static_cast<std::uint64_t>(elapsed_ns + 1) * 0xD1342543DE82EF95ULL);

  const std::uint32_t columns = (points_ + kRings - 1) / kRings;
  double cos_azimuth = 1.0;  // in the sensor's frame
  double sin_azimuth = 0.0;
  for (std::uint32_t i = 0; i < points_; ++i) {
    const std::uint32_t ring = i % kRings;
    const std::uint32_t column = i / kRings;
    const double turn = static_cast<double>(column) / columns;
    if (ring == 0) {
      const double azimuth = 2.0 * std::numbers::pi * (0.5 - turn);  // clockwise, from behind
      cos_azimuth = std::cos(azimuth);
      sin_azimuth = std::sin(azimuth);
    }
    const glm::dvec3 direction{cosines_[ring] * cos_azimuth, cosines_[ring] * sin_azimuth, sines_[ring]};
    const glm::dvec3 direction_in_map{c * direction.x - s * direction.y, s * direction.x + c * direction.y,
                                      direction.z};
    const Hit hit = caster.cast(direction_in_map, kMaxRange_m).value_or(Hit{.range_m = kMaxRange_m});
    const double range = std::max(0.1, hit.range_m + kRangeNoise_m * random.gaussian());
    const double incidence = std::abs(glm::dot(direction_in_map, hit.normal_in_map));
    const double reflected = appearance(hit.material).reflectivity * (0.25 + 0.75 * incidence);
    const double intensity = std::clamp(255.0 * reflected + 4.0 * random.gaussian(), 0.0, 255.0);

    std::byte* const point = data.data() + std::size_t{i} * kPointStep;
    const std::array<float, 4> values{static_cast<float>(range * direction.x), static_cast<float>(range * direction.y),
                                      static_cast<float>(range * direction.z), static_cast<float>(intensity)};
    const auto ring_id = static_cast<std::uint16_t>(ring);
    const auto time = static_cast<float>(0.1 * (turn - 1.0));  // seconds relative to the stamp
    std::memcpy(point, values.data(), sizeof values);
    std::memcpy(point + 16, &ring_id, sizeof ring_id);
    std::memcpy(point + 18, &time, sizeof time);
  }
}

}  // namespace stillframe::sample
