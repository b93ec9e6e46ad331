#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scenegraph/objects/object.h"
#include "scenegraph/objects/payload.h"
#include "scenegraph/objects/point_cloud.h"
#include "tf/rigid_transform.h"
#include "tf/time.h"

namespace stillframe::scenegraph {

/// foxglove.VoxelGrid, foxglove_msgs/VoxelGrid, nav2_msgs/VoxelGrid (its bit columns unpacked by the converter).
///
/// Voxel (column x, row y, slice z) lies at z * slice_stride + y * row_stride + x * cell_stride; its centre is
/// ((x, y, z) + 0.5) * cell_size in the grid's own frame. Nothing has been checked against `data`.
struct VoxelGrid {
  static constexpr ObjectType kType = ObjectType::VoxelGrid;
  tf::TimePoint stamp;
  std::string frame_id;
  tf::RigidTransform origin;  ///< frame_from_grid: the corner of voxel (0, 0, 0)
  glm::dvec3 cell_size_m{0.0};
  std::uint32_t column_count = 0;
  std::uint32_t row_count = 0;
  std::uint32_t slice_count = 0;
  std::uint32_t cell_stride = 0;   ///< bytes
  std::uint32_t row_stride = 0;    ///< bytes
  std::uint32_t slice_stride = 0;  ///< bytes
  std::vector<PackedField> fields;
  Payload data;
  [[nodiscard]] std::size_t byteSize() const { return sizeof(*this) + data.bytes.size(); }
};

}  // namespace stillframe::scenegraph
