#include "tools/sample/ros2_messages.h"

#include "tools/ingest/cdr_writer.h"
#include "tools/sample/definition_text.h"

namespace stillframe::sample {
namespace {

constexpr std::string_view kTfMessage =
    "geometry_msgs/TransformStamped[] transforms\n" STILLFRAME_SEPARATOR
    "MSG: geometry_msgs/TransformStamped\n"
    "# This expresses a transform from coordinate frame header.frame_id\n"
    "# to the coordinate frame child_frame_id at the time of header.stamp\n"
    "\n"
    "# The frame id in the header is used as the reference frame of this transform.\n"
    "std_msgs/Header header\n"
    "\n"
    "# The frame id of the child frame to which this transform points.\n"
    "string child_frame_id\n"
    "\n"
    "# Translation and rotation in 3-dimensions of child_frame_id from header.frame_id.\n"
    "Transform transform\n" STILLFRAME_SEPARATOR
    "MSG: geometry_msgs/Transform\n"
    "# This represents the transform between two coordinate frames in free space.\n"
    "\n"
    "Vector3 translation\n"
    "Quaternion rotation\n" STILLFRAME_SEPARATOR
    "MSG: geometry_msgs/Quaternion\n"
    "# This represents an orientation in free space in quaternion form.\n"
    "\n"
    "float64 x 0\n"
    "float64 y 0\n"
    "float64 z 0\n"
    "float64 w 1\n" STILLFRAME_SEPARATOR
    "MSG: geometry_msgs/Vector3\n"
    "# This represents a vector in free space.\n"
    "\n"
    "float64 x\n"
    "float64 y\n"
    "float64 z\n" STILLFRAME_SEPARATOR
    "MSG: std_msgs/Header\n"
    "# Two-integer timestamp that is expressed as seconds and nanoseconds.\n"
    "builtin_interfaces/Time stamp\n"
    "\n"
    "# Transform frame with which this data is associated.\n"
    "string frame_id\n" STILLFRAME_SEPARATOR
    "MSG: builtin_interfaces/Time\n"
    "# The seconds component, valid over all int32 values.\n"
    "int32 sec\n"
    "\n"
    "# The nanoseconds component, valid in the range [0, 10e9).\n"
    "uint32 nanosec\n";

constexpr std::string_view kPointCloud2 =
    "# This message holds a collection of N-dimensional points, which may\n"
    "# contain additional information such as normals, intensity, etc. The\n"
    "# point data is stored as a binary blob, its layout described by the\n"
    "# contents of the \"fields\" array.\n"
    "\n"
    "# Time of sensor data acquisition, and the coordinate frame ID (for 3d points).\n"
    "std_msgs/Header header\n"
    "\n"
    "# 2D structure of the point cloud. If the cloud is unordered, height is\n"
    "# 1 and width is the length of the point cloud.\n"
    "uint32 height\n"
    "uint32 width\n"
    "\n"
    "# Describes the channels and their layout in the binary data blob.\n"
    "PointField[] fields\n"
    "\n"
    "bool    is_bigendian # Is this data bigendian?\n"
    "uint32  point_step   # Length of a point in bytes\n"
    "uint32  row_step     # Length of a row in bytes\n"
    "uint8[] data         # Actual point data, size is (row_step*height)\n"
    "\n"
    "bool is_dense        # True if there are no invalid points\n" STILLFRAME_SEPARATOR
    "MSG: sensor_msgs/PointField\n"
    "# This message holds the description of one point entry in the\n"
    "# PointCloud2 message format.\n"
    "uint8 INT8    = 1\n"
    "uint8 UINT8   = 2\n"
    "uint8 INT16   = 3\n"
    "uint8 UINT16  = 4\n"
    "uint8 INT32   = 5\n"
    "uint8 UINT32  = 6\n"
    "uint8 FLOAT32 = 7\n"
    "uint8 FLOAT64 = 8\n"
    "\n"
    "# Common PointField names are x, y, z, intensity, rgb, rgba\n"
    "string name      # Name of field\n"
    "uint32 offset    # Offset from start of point struct\n"
    "uint8  datatype  # Datatype enumeration, see above\n"
    "uint32 count     # How many elements in the field\n" STILLFRAME_SEPARATOR
    "MSG: std_msgs/Header\n"
    "# Two-integer timestamp that is expressed as seconds and nanoseconds.\n"
    "builtin_interfaces/Time stamp\n"
    "\n"
    "# Transform frame with which this data is associated.\n"
    "string frame_id\n" STILLFRAME_SEPARATOR
    "MSG: builtin_interfaces/Time\n"
    "# The seconds component, valid over all int32 values.\n"
    "int32 sec\n"
    "\n"
    "# The nanoseconds component, valid in the range [0, 10e9).\n"
    "uint32 nanosec\n";

}  // namespace

Ros2Type tfMessageType() { return {"tf2_msgs/msg/TFMessage", kTfMessage}; }
Ros2Type pointCloud2Type() { return {"sensor_msgs/msg/PointCloud2", kPointCloud2}; }

std::vector<std::byte> serializeTfMessage(std::span<const scenegraph::FrameTransform> transforms) {
  ingest::CdrWriter cdr;
  cdr.length(transforms.size());
  for (const auto& transform : transforms) {
    const auto& [rotation, translation] = transform.parent_from_child;
    cdr.header(transform.stamp.ns, transform.parent_frame_id).string(transform.child_frame_id);
    cdr.number(translation.x).number(translation.y).number(translation.z);
    cdr.number(rotation.x).number(rotation.y).number(rotation.z).number(rotation.w);
  }
  return cdr.bytes();
}

std::vector<std::byte> serializePointCloud2(const scenegraph::PointCloud& cloud) {
  ingest::CdrWriter cdr;
  cdr.header(cloud.stamp.ns, cloud.frame_id).number(cloud.height).number(cloud.width).length(cloud.fields.size());
  for (const auto& field : cloud.fields) {
    cdr.string(field.name).number(field.offset).number(static_cast<std::uint8_t>(field.type)).number(field.count);
  }
  cdr.number(static_cast<std::uint8_t>(cloud.is_bigendian)).number(cloud.point_step).number(cloud.row_step);
  cdr.byteSequence(cloud.data.bytes).number(static_cast<std::uint8_t>(cloud.is_dense));
  return cdr.bytes();
}

}  // namespace stillframe::sample
