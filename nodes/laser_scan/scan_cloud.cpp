#include "nodes/laser_scan/scan_cloud.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

namespace stillframe::nodes {
namespace {

constexpr std::uint32_t kPointStep = 32;  // x y z range, intensity, 4 spare, t
constexpr std::uint32_t kTimeOffset = 24;

scenegraph::Status fault(const char* code, std::string message) {
  return {scenegraph::StatusLevel::Error, code, std::move(message)};
}

}  // namespace

std::expected<ScanCloud, scenegraph::Status> convertScan(const scenegraph::LaserScan& scan) {
  const std::size_t beams = scan.ranges_m.size();
  if (beams > kMaxBeams) {
    return std::unexpected(fault("TooManyBeams", "the scan has " + std::to_string(beams) + " beams, more than the " +
                                                     std::to_string(kMaxBeams) + " that are drawn"));
  }
  ScanCloud result;
  result.duration_s = beams > 1 ? scan.time_increment_s * static_cast<double>(beams - 1) : 0.0;
  if (!std::isfinite(scan.angle_min_rad) || !std::isfinite(scan.angle_increment_rad * static_cast<double>(beams)) ||
      !std::isfinite(result.duration_s) || !tf::isFinite(scan.pose)) {
    return std::unexpected(fault("MalformedScan", "the scan's angle_min " + std::to_string(scan.angle_min_rad) +
                                                      ", angle_increment " + std::to_string(scan.angle_increment_rad) +
                                                      ", time_increment " + std::to_string(scan.time_increment_s) +
                                                      " or pose is not finite"));
  }
  const bool has_intensity = beams > 0 && scan.intensities.size() == beams;
  auto bytes = std::make_shared<std::vector<std::byte>>(beams * kPointStep);
  std::byte* out = bytes->data();
  for (std::size_t i = 0; i < beams; ++i) {
    const double range = scan.ranges_m[i];
    if (!std::isfinite(range) || range < scan.range_min_m || range > scan.range_max_m) {
      ++result.dropped;
      continue;
    }
    const double angle = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    const std::array<float, 5> values{static_cast<float>(range * std::cos(angle)),
                                      static_cast<float>(range * std::sin(angle)), 0.0F, static_cast<float>(range),
                                      has_intensity ? static_cast<float>(scan.intensities[i]) : 0.0F};
    const double after_first_s = static_cast<double>(i) * scan.time_increment_s;
    std::memcpy(out, values.data(), sizeof values);
    std::memcpy(out + kTimeOffset, &after_first_s, sizeof after_first_s);
    out += kPointStep;
  }
  bytes->resize((beams - result.dropped) * kPointStep);

  using scenegraph::FieldType;
  scenegraph::PointCloud& cloud = result.cloud;
  cloud.stamp = scan.stamp;
  cloud.frame_id = scan.frame_id;
  cloud.pose = scan.pose;
  cloud.width = static_cast<std::uint32_t>(beams - result.dropped);
  cloud.point_step = kPointStep;
  cloud.row_step = cloud.width * kPointStep;
  cloud.is_bigendian = std::endian::native == std::endian::big;
  cloud.fields = {{"x", 0, FieldType::Float32},
                  {"y", 4, FieldType::Float32},
                  {"z", 8, FieldType::Float32},
                  {"range", 12, FieldType::Float32},
                  {"t", kTimeOffset, FieldType::Float64}};
  if (has_intensity) {
    cloud.fields.insert(cloud.fields.begin() + 3, {"intensity", 16, FieldType::Float32});
  }
  cloud.data = {*bytes, bytes};
  return result;
}

}  // namespace stillframe::nodes
