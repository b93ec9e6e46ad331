#include "nodes/occupancy_grid/grid_header.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "scenegraph/settings.h"
#include "tf/transform_buffer.h"

namespace stillframe::nodes {
namespace {

using scenegraph::OccupancyGrid;
using scenegraph::Status;
using scenegraph::StatusLevel;

// A cell must be a normal float, and so must the whole grid be.
constexpr double kLeastResolution_m = 1e-30;
constexpr double kGreatestSide_m = 1e30;
constexpr double kUnitTolerance = 1e-3;

std::unexpected<Status> fault(const std::string& code, const std::string& message) {
  return std::unexpected(Status{StatusLevel::Error, code, message});
}

std::string sizeText(const OccupancyGrid& grid) {
  return std::to_string(grid.width) + " x " + std::to_string(grid.height) + " cells";
}

}  // namespace

std::uint32_t tileEdge(std::uint32_t width, std::uint32_t height) noexcept {
  constexpr std::uint64_t kGoodTiles = 400;
  constexpr std::uint64_t kMostTiles = 1024;
  const auto tiles = [&](std::uint64_t edge) { return ((width + edge - 1) / edge) * ((height + edge - 1) / edge); };
  for (const std::uint32_t edge : {256U, 512U, 1024U}) {
    if (tiles(edge) <= kGoodTiles) {
      return edge;
    }
  }
  return tiles(2048) <= kMostTiles ? 2048 : 0;
}

std::uint32_t blockEdge(std::uint32_t width, std::uint32_t height) noexcept {
  constexpr std::uint64_t kMostBlocks = 16384;
  std::uint32_t edge = 64;
  while (edge < 256 && (std::uint64_t{width} / edge + 1) * (std::uint64_t{height} / edge + 1) > kMostBlocks + 512) {
    edge *= 2;
  }
  return edge;
}

std::expected<GridHeader, Status> checkGrid(const OccupancyGrid& grid) {
  const std::uint64_t cells = std::uint64_t{grid.width} * grid.height;
  if (grid.data.bytes.size() < cells) {
    return fault("MalformedGrid", sizeText(grid) + " need " + std::to_string(cells) + " bytes, the message holds " +
                                      std::to_string(grid.data.bytes.size()));
  }
  const std::uint32_t edge = tileEdge(grid.width, grid.height);
  if (cells > kMaxGridCells || edge == 0) {
    return fault("GridTooLarge", sizeText(grid) + " are more than is drawn: at most " + std::to_string(kMaxGridCells) +
                                     " cells in 1024 tiles of 2048 x 2048");
  }
  const double resolution_m = grid.resolution_m;
  const double side_m = resolution_m * std::max({1U, grid.width, grid.height});
  if (!(resolution_m >= kLeastResolution_m) || !(side_m <= kGreatestSide_m)) {
    return fault("BadResolution", "the edge of a cell is " + scenegraph::settingText(resolution_m) +
                                      " m: it must be a positive, finite length");
  }
  GridHeader header;
  header.stamp = grid.stamp;
  header.frame_id = std::string(tf::stripLeadingSlashes(grid.frame_id));
  header.frame_from_grid = grid.origin;
  header.resolution_m = resolution_m;
  header.width = grid.width;
  header.height = grid.height;
  header.tile_edge = edge;
  header.block_edge = blockEdge(grid.width, grid.height);
  if (!tf::isFinite(grid.origin)) {
    return fault("BadOrigin", "the origin has a NaN or infinite component");
  }
  glm::dquat& rotation = header.frame_from_grid.rotation;
  // Scaled first: the square of a very large or small component must not leave the range of double.
  const double largest =
      std::max({std::abs(rotation.w), std::abs(rotation.x), std::abs(rotation.y), std::abs(rotation.z)});
  if (largest == 0.0) {
    rotation = {1.0, 0.0, 0.0, 0.0};
    header.note = {StatusLevel::Info, "ZeroRotation",
                   "the origin's quaternion is all zero: the grid is drawn without a rotation"};
    return header;
  }
  const glm::dquat scaled = rotation / largest;
  const double norm = glm::length(scaled);
  rotation = scaled / norm;
  if (std::abs(norm * largest - 1.0) > kUnitTolerance) {
    header.note = {StatusLevel::Info, "UnnormalisedRotation",
                   "the origin's quaternion has length " + scenegraph::settingText(norm * largest) +
                       " instead of 1: it is drawn normalised"};
  }
  return header;
}

}  // namespace stillframe::nodes
