#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenegraph/objects/object.h"
#include "scenegraph/objects/payload.h"
#include "tf/rigid_transform.h"
#include "tf/time.h"

namespace stillframe::scenegraph {

/// Type of a packed field; the numbers are those of sensor_msgs/PointField, not Foxglove's.
enum class FieldType : std::uint8_t {
  Unknown = 0,
  Int8 = 1,
  Uint8 = 2,
  Int16 = 3,
  Uint16 = 4,
  Int32 = 5,
  Uint32 = 6,
  Float32 = 7,
  Float64 = 8,
};

/// Bytes of one value; 0 for Unknown.
[[nodiscard]] constexpr std::uint32_t byteSize(FieldType type) noexcept {
  constexpr std::uint32_t kSizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::uint8_t>(type) <= 8 ? static_cast<std::uint8_t>(type) : 0];
}

/// One field of a packed record (cloud point, voxel, grid-map cell).
struct PackedField {
  std::string name;
  std::uint32_t offset = 0;  ///< bytes from the start of the record
  FieldType type = FieldType::Unknown;
  std::uint32_t count = 1;  ///< values in a row; 0 is read as 1, as PCL does
};

/// How a 4-byte integer colour field (`rgba`, `rgb`) is packed. One of type FLOAT32 is always PCL's.
enum class ColorPacking : std::uint8_t {
  RgbaBytes,  ///< bytes R, G, B, A in increasing address order, whatever the endianness: Foxglove and canonical
  PclWord,    ///< the word 0xAARRGGBB in the cloud's endianness: sensor_msgs/PointCloud2 as PCL writes it
};

/// sensor_msgs/PointCloud2, foxglove.PointCloud, and what compressed clouds decode to.
///
/// Nothing has been checked: sizes may lie, fields may overlap. Point i lies at
/// (i / width) * row_step + (i % width) * point_step. Colour is one field `rgba`/`rgb` of 4 bytes; see nodes/points.
struct PointCloud {
  static constexpr ObjectType kType = ObjectType::PointCloud;
  tf::TimePoint stamp;  ///< header stamp
  std::string frame_id;
  tf::RigidTransform pose;  ///< frame_from_points; identity unless the source has one (foxglove.PointCloud.pose)
  std::uint32_t width = 0;
  std::uint32_t height = 1;
  std::uint32_t point_step = 0;  ///< bytes
  std::uint32_t row_step = 0;    ///< bytes
  bool is_bigendian = false;
  bool is_dense = true;  ///< false: NaN points may be present. Not trusted.
  ColorPacking color_packing = ColorPacking::RgbaBytes;
  std::vector<PackedField> fields;
  Payload data;
  [[nodiscard]] std::size_t byteSize() const { return sizeof(*this) + data.bytes.size(); }
};

}  // namespace stillframe::scenegraph
