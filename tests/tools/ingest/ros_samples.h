#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tools/ingest/cdr_writer.h"

namespace stillframe::ingest::test {

inline constexpr std::string_view kTransformDefinition = R"(std_msgs/Header header
string child_frame_id
Transform transform
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: geometry_msgs/Transform
Vector3 translation
Quaternion rotation
================================================================================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
================================================================================
MSG: geometry_msgs/Quaternion
float64 x 0
float64 y 0
float64 z 0
float64 w 1
)";

/// tf2_msgs/msg/TFMessage as ROS 2 writes it down.
inline std::string tfDefinition() {
  return "geometry_msgs/TransformStamped[] transforms\n"
         "================================================================================\n"
         "MSG: geometry_msgs/TransformStamped\n" +
         std::string(kTransformDefinition);
}

inline constexpr std::string_view kCloudDefinition = R"(# a cloud
std_msgs/msg/Header header
uint32 height
uint32 width
PointField[] fields
bool    is_bigendian # order
uint32  point_step
uint32  row_step
uint8[] data
bool is_dense
================================================================================
MSG: sensor_msgs/msg/PointField
uint8 INT8    = 1
uint8 FLOAT32 = 7
string name
uint32 offset
uint8  datatype
uint32 count
================================================================================
MSG: std_msgs/msg/Header
builtin_interfaces/Time stamp
string frame_id
)";

/// A message of one transform whose translation is (x, 2, 3).
inline std::vector<std::byte> tfMessage(std::int64_t stamp_ns, std::string_view parent, std::string_view child,
                                        double x, ByteOrder order = ByteOrder::Little) {
  CdrWriter cdr(order);
  cdr.length(1).header(stamp_ns, parent).string(child);
  for (const double value : {x, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0}) {
    cdr.number(value);
  }
  return cdr.bytes();
}

/// A cloud of `points` points of x, y, z; byte i of its data is i modulo 251.
inline std::vector<std::byte> cloudMessage(std::int64_t stamp_ns, std::uint32_t points,
                                           ByteOrder order = ByteOrder::Little) {
  CdrWriter cdr(order);
  cdr.header(stamp_ns, "/lidar").number(std::uint32_t{1}).number(points).length(3);
  for (std::uint32_t i = 0; i < 3; ++i) {
    cdr.string(std::string(1, static_cast<char>('x' + i))).number(4 * i).number(std::uint8_t{7}).number(1u);
  }
  std::vector<std::byte> data(std::size_t{12} * points);
  for (std::size_t i = 0; i < data.size(); ++i) {
    data[i] = std::byte(i % 251);
  }
  cdr.number(std::uint8_t{0}).number(12u).number(12u * points).byteSequence(data).number(std::uint8_t{1});
  return cdr.bytes();
}

}  // namespace stillframe::ingest::test
