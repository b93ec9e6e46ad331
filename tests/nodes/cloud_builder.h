#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "nodes/points/convert_cloud.h"
#include "scenegraph/objects/point_cloud.h"

namespace stillframe::test {

using scenegraph::FieldType;
using scenegraph::PackedField;
using scenegraph::PointCloud;

/// Hands the bytes over to a cloud.
inline void setData(PointCloud& cloud, std::vector<std::byte> bytes) {
  const auto anchor = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
  cloud.data = {*anchor, anchor};
}

/// A cloud of one row from plain structs; `fields` describe the struct.
template <typename Point>
PointCloud makeCloud(std::vector<PackedField> fields, std::span<const Point> points) {
  PointCloud cloud;
  cloud.frame_id = "sensor";
  cloud.width = static_cast<std::uint32_t>(points.size());
  cloud.point_step = sizeof(Point);
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.fields = std::move(fields);
  std::vector<std::byte> bytes(points.size() * sizeof(Point));
  if (!bytes.empty()) {
    std::memcpy(bytes.data(), points.data(), bytes.size());
  }
  setData(cloud, std::move(bytes));
  return cloud;
}

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct Xyz {
  float x, y, z;
};
inline const std::vector<PackedField> kXyzFields = {
    {"x", 0, FieldType::Float32}, {"y", 4, FieldType::Float32}, {"z", 8, FieldType::Float32}};

[[nodiscard]] inline PointCloud xyzCloud(const std::vector<Xyz>& points) { return makeCloud<Xyz>(kXyzFields, points); }

/// The cloud and its positions in one.
struct Converted {
  nodes::ConvertedCloud cloud;
  std::vector<float> positions;
};

inline std::expected<Converted, nodes::CloudError> convert(const PointCloud& cloud) {
  Converted result;
  auto converted = nodes::convertCloud(cloud, [&](std::size_t floats) {
    result.positions.resize(floats);
    return result.positions.data();
  });
  if (!converted) {
    return std::unexpected(converted.error());
  }
  result.cloud = std::move(*converted);
  result.positions.resize(3 * result.cloud.points);
  return result;
}

}  // namespace stillframe::test
