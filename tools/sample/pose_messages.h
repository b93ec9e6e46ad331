#pragma once

#include <cstddef>
#include <vector>

#include "scenegraph/objects/poses.h"
#include "tools/sample/ros2_messages.h"

namespace stillframe::sample {

[[nodiscard]] Ros2Type odometryType();
[[nodiscard]] Ros2Type pathType();
[[nodiscard]] Ros2Type poseArrayType();
[[nodiscard]] Ros2Type polygonStampedType();

/// Little-endian CDR with its encapsulation header. Odometry takes the first pose and its covariance, and no speed; a
/// polygon the places of the poses.
[[nodiscard]] std::vector<std::byte> serializeOdometry(const scenegraph::PosesInFrame& odometry);
[[nodiscard]] std::vector<std::byte> serializePath(const scenegraph::PosesInFrame& path);
[[nodiscard]] std::vector<std::byte> serializePoseArray(const scenegraph::PosesInFrame& poses);
[[nodiscard]] std::vector<std::byte> serializePolygonStamped(const scenegraph::PosesInFrame& polygon);

}  // namespace stillframe::sample
