#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "tf/rigid_transform.h"
#include "tools/sample/ros2_messages.h"

namespace stillframe::sample {

/// visualization_msgs/msg/Marker, what the recording uses of it.
struct Marker {
  enum class Type : std::int32_t {
    Arrow = 0,
    Cube = 1,
    Sphere = 2,
    Cylinder = 3,
    LineStrip = 4,
    Text = 9,
    Mesh = 10,
    TriangleList = 11
  };

  std::int64_t stamp_ns = 0;
  std::string frame_id;
  std::string ns;
  std::int32_t id = 0;
  Type type = Type::Cube;
  bool is_deletion = false;
  tf::RigidTransform pose;
  glm::dvec3 scale{1.0};
  std::array<float, 4> rgba{1.0F, 1.0F, 1.0F, 1.0F};
  std::int64_t lifetime_ns = 0;
  bool is_frame_locked = true;
  std::vector<glm::dvec3> points = {};
  std::string text = {};
  std::vector<glm::vec2> uvs = {};  ///< one a point, v downwards
  std::string texture_resource = {};
  std::vector<std::byte> texture_png = {};  ///< of "embedded://..."
  std::string mesh_resource = {};
  std::string mesh_filename = {};  ///< of mesh_data
  std::vector<std::byte> mesh_data = {};
};

[[nodiscard]] Ros2Type markerArrayType();
/// Little-endian CDR with its encapsulation header.
[[nodiscard]] std::vector<std::byte> serializeMarkerArray(std::span<const Marker> markers);

}  // namespace stillframe::sample
