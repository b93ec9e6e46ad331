#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "scenegraph/objects/object.h"
#include "scenegraph/objects/payload.h"
#include "scenegraph/objects/point_cloud.h"
#include "tf/rigid_transform.h"
#include "tf/time.h"

namespace stillframe::scenegraph {

/// grid_map_msgs/GridMap (ring buffer unrolled, axes turned, layers interleaved by the converter) and foxglove.Grid.
///
/// Cell (column x, row y) lies at y * row_stride + x * cell_stride; its corner is (x, y) * cell_size in the grid's own
/// frame. NaN = no data. A field named `elevation` is the height in metres.
struct GridMap {
  static constexpr ObjectType kType = ObjectType::GridMap;
  tf::TimePoint stamp;
  std::string frame_id;
  tf::RigidTransform origin;  ///< frame_from_grid: the corner of cell (0, 0)
  glm::dvec2 cell_size_m{0.0};
  std::uint32_t column_count = 0;
  std::uint32_t row_count = 0;
  std::uint32_t cell_stride = 0;  ///< bytes
  std::uint32_t row_stride = 0;   ///< bytes
  std::vector<PackedField> fields;
  Payload data;
  [[nodiscard]] std::size_t byteSize() const { return sizeof(*this) + data.bytes.size(); }
};

}  // namespace stillframe::scenegraph
