#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/objects/frame_transforms.h"
#include "scenegraph/objects/point_cloud.h"

namespace stillframe::sample {

/// A ROS 2 type: its name, and its definition as a recorder stores it (schema encoding "ros2msg").
struct Ros2Type {
  std::string_view name;
  std::string_view definition;
};

[[nodiscard]] Ros2Type tfMessageType();
[[nodiscard]] Ros2Type pointCloud2Type();

/// Little-endian CDR with its encapsulation header.
[[nodiscard]] std::vector<std::byte> serializeTfMessage(std::span<const scenegraph::FrameTransform> transforms);
[[nodiscard]] std::vector<std::byte> serializePointCloud2(const scenegraph::PointCloud& cloud);

}  // namespace stillframe::sample
