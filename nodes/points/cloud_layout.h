#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <string>
#include <string_view>

#include "scenegraph/objects/point_cloud.h"

namespace stillframe::nodes {

/// Why a cloud cannot be drawn.
enum class CloudErrorCode : std::uint8_t {
  MalformedCloud,          ///< the sizes it states do not fit its data, or a field leaves its point
  MissingCoordinates,      ///< no field x, y or z
  UnsupportedCoordinates,  ///< x, y or z has a data type that does not exist
};
[[nodiscard]] std::string_view toString(CloudErrorCode code) noexcept;

struct CloudError {
  CloudErrorCode code = CloudErrorCode::MalformedCloud;
  std::string message;  ///< one sentence with the numbers; topic and time are the caller's to add
};

/// Where the points of a checked cloud lie: every byte of every field of every point is inside the data.
struct CloudLayout {
  std::size_t rows = 0;  ///< 1 when the rows follow each other without padding
  std::size_t points_per_row = 0;
  std::size_t point_step = 0;                           ///< bytes
  std::size_t row_step = 0;                             ///< bytes
  std::array<const scenegraph::PackedField*, 3> xyz{};  ///< into the cloud's fields; null for zero points
  [[nodiscard]] std::size_t points() const noexcept { return rows * points_per_row; }
};

/// Checks every size a cloud states, without overflow, before anybody reads it. O(fields).
///
/// Zero points are fine whatever the fields. A row_step of 0 is read as packed rows; rows that overlap are refused,
/// so that the points are never more than the bytes.
[[nodiscard]] std::expected<CloudLayout, CloudError> checkLayout(const scenegraph::PointCloud& cloud);

}  // namespace stillframe::nodes
