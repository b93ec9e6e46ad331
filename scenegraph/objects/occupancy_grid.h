#pragma once

#include <cstdint>
#include <string>

#include "scenegraph/objects/object.h"
#include "scenegraph/objects/payload.h"
#include "tf/rigid_transform.h"
#include "tf/time.h"

namespace stillframe::scenegraph {

/// nav_msgs/OccupancyGrid: int8 cells, row-major, row 0 at y = 0; -1 unknown, 0..100 per cent, anything else invalid.
/// Nothing has been checked: `data` may be shorter than width * height.
struct OccupancyGrid {
  static constexpr ObjectType kType = ObjectType::OccupancyGrid;
  tf::TimePoint stamp;
  std::string frame_id;
  tf::RigidTransform origin;  ///< frame_from_grid: the corner of cell (0, 0); rotation as sent, not yet normalised
  double resolution_m = 0.0;  ///< edge of a cell, both ways
  std::uint32_t width = 0;    ///< cells along x
  std::uint32_t height = 0;   ///< cells along y
  Payload data;
  [[nodiscard]] std::size_t byteSize() const { return sizeof(*this) + data.bytes.size(); }
};

/// map_msgs/OccupancyGridUpdate: a patch of the grid on the topic without the suffix "_updates".
struct OccupancyGridUpdate {
  static constexpr ObjectType kType = ObjectType::OccupancyGridUpdate;
  tf::TimePoint stamp;
  std::string frame_id;
  std::int32_t x = 0;  ///< column of the patch's first cell in the base grid; may be negative: clip
  std::int32_t y = 0;  ///< row
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  Payload data;
  [[nodiscard]] std::size_t byteSize() const { return sizeof(*this) + data.bytes.size(); }
};

}  // namespace stillframe::scenegraph
