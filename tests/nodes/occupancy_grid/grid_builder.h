#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/objects/occupancy_grid.h"

namespace stillframe::test {

inline scenegraph::Payload cellPayload(const std::vector<std::int8_t>& cells) {
  const auto bytes = std::make_shared<std::vector<std::byte>>();
  for (const std::int8_t cell : cells) {
    bytes->push_back(static_cast<std::byte>(cell));
  }
  return {*bytes, bytes};
}

/// A grid of `width` columns; as many rows as `cells` fill.
inline scenegraph::OccupancyGrid makeGrid(std::uint32_t width, const std::vector<std::int8_t>& cells,
                                          const std::string& frame = "map", double resolution_m = 1.0) {
  scenegraph::OccupancyGrid grid;
  grid.frame_id = frame;
  grid.resolution_m = resolution_m;
  grid.width = width;
  grid.height = width == 0 ? 0 : static_cast<std::uint32_t>(cells.size()) / width;
  grid.data = cellPayload(cells);
  return grid;
}

inline scenegraph::OccupancyGrid makeUniformGrid(std::uint32_t width, std::uint32_t height, std::int8_t value,
                                                 const std::string& frame = "map", double resolution_m = 1.0) {
  return makeGrid(width, std::vector<std::int8_t>(std::size_t{width} * height, value), frame, resolution_m);
}

/// A patch of `width` columns; as many rows as `cells` fill.
inline scenegraph::OccupancyGridUpdate makePatch(std::int32_t x, std::int32_t y, std::uint32_t width,
                                                 const std::vector<std::int8_t>& cells,
                                                 const std::string& frame = "map") {
  scenegraph::OccupancyGridUpdate patch;
  patch.frame_id = frame;
  patch.x = x;
  patch.y = y;
  patch.width = width;
  patch.height = width == 0 ? 0 : static_cast<std::uint32_t>(cells.size()) / width;
  patch.data = cellPayload(cells);
  return patch;
}

}  // namespace stillframe::test
