#pragma once

#include <cstddef>
#include <vector>

#include "scenegraph/objects/occupancy_grid.h"
#include "tools/sample/ros2_messages.h"

namespace stillframe::sample {

[[nodiscard]] Ros2Type occupancyGridType();
[[nodiscard]] Ros2Type occupancyGridUpdateType();

/// Little-endian CDR with its encapsulation header.
[[nodiscard]] std::vector<std::byte> serializeOccupancyGrid(const scenegraph::OccupancyGrid& grid);
[[nodiscard]] std::vector<std::byte> serializeOccupancyGridUpdate(const scenegraph::OccupancyGridUpdate& patch);

}  // namespace stillframe::sample
