#include "nodes/points/cloud_layout.h"

#include <limits>

namespace stillframe::nodes {
namespace {

using scenegraph::PackedField;
using scenegraph::PointCloud;

std::unexpected<CloudError> malformedCloud(std::string message) {
  return std::unexpected(CloudError{CloudErrorCode::MalformedCloud, std::move(message)});
}

std::string stated(const PointCloud& cloud) {
  return std::to_string(cloud.width) + " x " + std::to_string(cloud.height) + " points of " +
         std::to_string(cloud.point_step) + " bytes in rows of " + std::to_string(cloud.row_step) + " bytes";
}

std::expected<void, CloudError> checkFields(const PointCloud& cloud) {
  for (const PackedField& field : cloud.fields) {
    const std::uint64_t values = field.count == 0 ? 1 : field.count;
    const std::uint64_t end = field.offset + values * scenegraph::byteSize(field.type);
    if (end > cloud.point_step) {
      return malformedCloud("field '" + field.name + "' ends at byte " + std::to_string(end) + " of a point of " +
                            std::to_string(cloud.point_step) + " bytes");
    }
  }
  return {};
}

std::expected<const PackedField*, CloudError> findCoordinate(const PointCloud& cloud, std::string_view name) {
  for (const PackedField& field : cloud.fields) {
    if (field.name != name) {
      continue;
    }
    if (scenegraph::byteSize(field.type) == 0) {
      return std::unexpected(CloudError{
          CloudErrorCode::UnsupportedCoordinates,
          "field '" + field.name + "' has the unknown data type " + std::to_string(static_cast<unsigned>(field.type))});
    }
    return &field;
  }
  std::string names;
  for (const PackedField& field : cloud.fields) {
    names += (names.empty() ? "" : ", ") + field.name;
  }
  return std::unexpected(CloudError{CloudErrorCode::MissingCoordinates, "no field '" + std::string(name) + "' among " +
                                                                            (names.empty() ? "none at all" : names)});
}

}  // namespace

std::string_view toString(CloudErrorCode code) noexcept {
  switch (code) {
    case CloudErrorCode::MalformedCloud:
      return "MalformedCloud";
    case CloudErrorCode::MissingCoordinates:
      return "MissingCoordinates";
    case CloudErrorCode::UnsupportedCoordinates:
      return "UnsupportedCoordinates";
  }
  return "MalformedCloud";
}

std::expected<CloudLayout, CloudError> checkLayout(const PointCloud& cloud) {
  CloudLayout layout;
  if (cloud.width == 0 || cloud.height == 0) {
    return layout;
  }
  if (cloud.point_step == 0) {
    return malformedCloud("the point step is 0 bytes for " + stated(cloud));
  }
  if (const auto fields = checkFields(cloud); !fields) {
    return std::unexpected(fields.error());
  }
  // 32-bit factors: no product can overflow 64 bits, and each is compared before it is added.
  const std::uint64_t row_bytes = std::uint64_t{cloud.width} * cloud.point_step;
  const std::uint64_t row_step = cloud.row_step == 0 ? row_bytes : cloud.row_step;
  if (cloud.height > 1 && row_step < row_bytes) {
    return malformedCloud("rows overlap: " + stated(cloud));
  }
  const std::uint64_t size = cloud.data.bytes.size();
  // row_step may be a 64-bit product here, hence the division.
  if (row_bytes > size || (cloud.height > 1 && row_step > (size - row_bytes) / (cloud.height - 1))) {
    return malformedCloud(stated(cloud) + " do not fit " + std::to_string(size) + " bytes of data");
  }
  if (std::uint64_t{cloud.width} * cloud.height > std::numeric_limits<std::int32_t>::max()) {
    return malformedCloud(stated(cloud) + " are more than one draw call can take");
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    constexpr std::string_view kNames[] = {"x", "y", "z"};
    const auto field = findCoordinate(cloud, kNames[axis]);
    if (!field) {
      return std::unexpected(field.error());
    }
    layout.xyz[axis] = *field;
  }
  const bool is_packed = row_step == row_bytes || cloud.height == 1;
  layout.rows = is_packed ? 1 : cloud.height;
  layout.points_per_row = is_packed ? std::size_t{cloud.width} * cloud.height : cloud.width;
  layout.point_step = cloud.point_step;
  layout.row_step = row_step;
  return layout;
}

}  // namespace stillframe::nodes
