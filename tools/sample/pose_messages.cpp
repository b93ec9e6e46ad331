#include "tools/sample/pose_messages.h"

#include <array>

#include "tools/ingest/cdr_writer.h"
#include "tools/sample/definition_text.h"

namespace stillframe::sample {
namespace {

constexpr std::string_view kOdometry =
    "std_msgs/Header header\n"
    "string child_frame_id\n"
    "geometry_msgs/PoseWithCovariance pose\n"
    "geometry_msgs/TwistWithCovariance twist\n" STILLFRAME_SEPARATOR
    "MSG: geometry_msgs/PoseWithCovariance\n"
    "Pose pose\n"
    "# Row-major representation of the 6x6 covariance matrix\n"
    "float64[36] covariance\n" STILLFRAME_SEPARATOR
    "MSG: geometry_msgs/TwistWithCovariance\n"
    "Twist twist\n"
    "float64[36] covariance\n" STILLFRAME_SEPARATOR
    "MSG: geometry_msgs/Twist\n"
    "Vector3 linear\n"
    "Vector3 angular\n" STILLFRAME_SEPARATOR
    "MSG: geometry_msgs/Vector3\n"
    "float64 x\n"
    "float64 y\n"
    "float64 z\n" STILLFRAME_POSE STILLFRAME_HEADER;

constexpr std::string_view kPath =
    "std_msgs/Header header\n"
    "geometry_msgs/PoseStamped[] poses\n" STILLFRAME_SEPARATOR
    "MSG: geometry_msgs/PoseStamped\n"
    "std_msgs/Header header\n"
    "Pose pose\n" STILLFRAME_POSE STILLFRAME_HEADER;

constexpr std::string_view kPoseArray =
    "std_msgs/Header header\n"
    "Pose[] poses\n" STILLFRAME_POSE STILLFRAME_HEADER;

constexpr std::string_view kPolygonStamped =
    "std_msgs/Header header\n"
    "geometry_msgs/Polygon polygon\n" STILLFRAME_SEPARATOR
    "MSG: geometry_msgs/Polygon\n"
    "Point32[] points\n" STILLFRAME_SEPARATOR
    "MSG: geometry_msgs/Point32\n"
    "float32 x\n"
    "float32 y\n"
    "float32 z\n" STILLFRAME_HEADER;

void write(ingest::CdrWriter& cdr, const tf::RigidTransform& pose) {
  const auto& [rotation, translation] = pose;
  for (const double value :
       {translation.x, translation.y, translation.z, rotation.x, rotation.y, rotation.z, rotation.w}) {
    cdr.number(value);
  }
}

}  // namespace

Ros2Type odometryType() { return {"nav_msgs/msg/Odometry", kOdometry}; }
Ros2Type pathType() { return {"nav_msgs/msg/Path", kPath}; }
Ros2Type poseArrayType() { return {"geometry_msgs/msg/PoseArray", kPoseArray}; }
Ros2Type polygonStampedType() { return {"geometry_msgs/msg/PolygonStamped", kPolygonStamped}; }

std::vector<std::byte> serializeOdometry(const scenegraph::PosesInFrame& odometry) {
  ingest::CdrWriter cdr;
  cdr.header(odometry.stamp.ns, odometry.frame_id).string(odometry.child_frame_id);
  write(cdr, odometry.poses.front());
  for (const double value : odometry.covariance.value_or(std::array<double, 36>{})) {
    cdr.number(value);
  }
  for (int i = 0; i < 6 + 36; ++i) {
    cdr.number(0.0);
  }
  return cdr.bytes();
}

std::vector<std::byte> serializePath(const scenegraph::PosesInFrame& path) {
  ingest::CdrWriter cdr;
  cdr.header(path.stamp.ns, path.frame_id).length(path.poses.size());
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    cdr.header(path.stamps[i].ns, path.frame_id);
    write(cdr, path.poses[i]);
  }
  return cdr.bytes();
}

std::vector<std::byte> serializePoseArray(const scenegraph::PosesInFrame& poses) {
  ingest::CdrWriter cdr;
  cdr.header(poses.stamp.ns, poses.frame_id).length(poses.poses.size());
  for (const tf::RigidTransform& pose : poses.poses) {
    write(cdr, pose);
  }
  return cdr.bytes();
}

std::vector<std::byte> serializePolygonStamped(const scenegraph::PosesInFrame& polygon) {
  ingest::CdrWriter cdr;
  cdr.header(polygon.stamp.ns, polygon.frame_id).length(polygon.poses.size());
  for (const tf::RigidTransform& pose : polygon.poses) {
    for (int axis = 0; axis < 3; ++axis) {
      cdr.number(static_cast<float>(pose.translation[axis]));
    }
  }
  return cdr.bytes();
}

}  // namespace stillframe::sample
