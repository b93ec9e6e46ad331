#pragma once

#include <cstdint>
#include <expected>
#include <string>

#include "scenegraph/objects/occupancy_grid.h"
#include "scenegraph/status.h"
#include "tf/rigid_transform.h"
#include "tf/time.h"

namespace stillframe::nodes {

/// What a base grid says beside its cells, checked.
struct GridHeader {
  tf::TimePoint stamp;
  std::string frame_id;                ///< without leading slashes
  tf::RigidTransform frame_from_grid;  ///< unit rotation; the corner of cell (0, 0)
  double resolution_m = 1.0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t tile_edge = 0;   ///< cells along a side of the tiles that the grid is drawn in
  std::uint32_t block_edge = 0;  ///< cells along a side of the blocks that states share; divides tile_edge
  /// Info where the origin was not as it should be ("ZeroRotation", "UnnormalisedRotation"), else Ok.
  scenegraph::Status note;

  [[nodiscard]] std::uint64_t cellCount() const noexcept { return std::uint64_t{width} * height; }
};

/// Cells that are drawn at most: 20 000 x 20 000 and some.
constexpr std::uint64_t kMaxGridCells = std::uint64_t{1} << 29U;

/// Edge of the tiles for a grid of that size: 256 cells, more for large grids so that about 400 tiles suffice; 0 when
/// even tiles of 2048 cells, the least texture that OpenGL 4 promises fourfold, would be too many.
[[nodiscard]] std::uint32_t tileEdge(std::uint32_t width, std::uint32_t height) noexcept;

/// Edge of the blocks: 64 cells, so that a patch copies little more than itself; more for grids above 8192 x 8192, so
/// that copying a state stays cheap.
[[nodiscard]] std::uint32_t blockEdge(std::uint32_t width, std::uint32_t height) noexcept;

/// Errors: "MalformedGrid" (fewer bytes than cells), "BadResolution", "BadOrigin", "GridTooLarge". The message is
/// without topic and time.
[[nodiscard]] std::expected<GridHeader, scenegraph::Status> checkGrid(const scenegraph::OccupancyGrid& grid);

}  // namespace stillframe::nodes
