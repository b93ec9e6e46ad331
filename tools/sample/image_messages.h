#pragma once

#include <cstddef>
#include <vector>

#include "scenegraph/objects/image.h"
#include "tools/sample/ros2_messages.h"

namespace stillframe::sample {

[[nodiscard]] Ros2Type imageType();
[[nodiscard]] Ros2Type cameraInfoType();

/// Little-endian CDR with its encapsulation header.
[[nodiscard]] std::vector<std::byte> serializeImage(const scenegraph::Image& image);
[[nodiscard]] std::vector<std::byte> serializeCameraInfo(const scenegraph::CameraInfo& info);

}  // namespace stillframe::sample
