#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenegraph/objects/object.h"
#include "tf/rigid_transform.h"
#include "tf/time.h"

namespace stillframe::scenegraph {

/// What a message of poses meant, which is what a layer draws by default.
enum class PosesKind : std::uint8_t {
  Array,    ///< geometry_msgs/PoseArray, foxglove.PosesInFrame
  Path,     ///< nav_msgs/Path: a line through the poses in order
  Single,   ///< PoseStamped, PoseWithCovarianceStamped, Odometry, foxglove.PoseInFrame
  Point,    ///< geometry_msgs/PointStamped, foxglove.Point3InFrame
  Polygon,  ///< geometry_msgs/PolygonStamped: a closed line
};

/// Poses in one frame with one stamp.
struct PosesInFrame {
  static constexpr ObjectType kType = ObjectType::PosesInFrame;
  tf::TimePoint stamp;
  std::string frame_id;
  PosesKind kind = PosesKind::Array;
  std::vector<tf::RigidTransform> poses;             ///< frame_from_pose; rotation as sent, not yet normalised
  std::vector<tf::TimePoint> stamps;                 ///< Path: of each pose; else empty
  std::optional<std::array<double, 36>> covariance;  ///< Single: row-major x y z rx ry rz about the frame's axes (ROS)
  std::string child_frame_id;                        ///< Odometry
  [[nodiscard]] std::size_t byteSize() const {
    return sizeof(*this) + poses.size() * sizeof(tf::RigidTransform) + stamps.size() * sizeof(tf::TimePoint);
  }
};

}  // namespace stillframe::scenegraph
