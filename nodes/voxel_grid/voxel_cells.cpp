#include "nodes/voxel_grid/voxel_cells.h"

#include <algorithm>
#include <optional>
#include <string>

namespace stillframe::nodes {
namespace {

using scenegraph::Status;
using scenegraph::StatusLevel;
using scenegraph::VoxelGrid;

std::unexpected<Status> malformedVoxels(std::string message) {
  return std::unexpected(Status{StatusLevel::Error, "MalformedGrid", std::move(message)});
}

std::string sizeText(const VoxelGrid& grid) {
  return std::to_string(grid.column_count) + " x " + std::to_string(grid.row_count) + " x " +
         std::to_string(grid.slice_count) + " voxels";
}

bool canBePlaced(const VoxelGrid& grid) {
  const auto isSize = [](double size_m, std::uint32_t count) {
    return size_m > 0.0 && size_m * std::max(count, 1U) < ConvertedCloud::kReach;
  };
  return isSize(grid.cell_size_m.x, grid.column_count) && isSize(grid.cell_size_m.y, grid.row_count) &&
         isSize(grid.cell_size_m.z, grid.slice_count) && tf::isFinite(grid.origin);
}

/// Bytes from the first voxel to the end of the last along one axis, each of its steps needing `inner`; nullopt when
/// they overlap.
std::optional<std::uint64_t> extent(std::uint32_t count, std::uint32_t stride, std::uint64_t inner) {
  if (count > 1 && stride < inner) {
    return std::nullopt;
  }
  return std::uint64_t{count - 1} * stride + inner;
}

}  // namespace

std::expected<PackedCells, Status> readVoxelCells(const VoxelGrid& grid) {
  if (!canBePlaced(grid)) {
    return malformedVoxels("cells of " + std::to_string(grid.cell_size_m.x) + " x " +
                           std::to_string(grid.cell_size_m.y) + " x " + std::to_string(grid.cell_size_m.z) +
                           " m cannot be placed, or the origin is not finite");
  }
  PackedCells cells = readPackedCells(grid.fields, grid.data);
  const bool is_empty = grid.column_count == 0 || grid.row_count == 0 || grid.slice_count == 0;
  if (is_empty) {
    return cells;
  }
  // No product of the counts overflows: two of them are 64 bits, and the third comes after the limit.
  const std::uint64_t in_slice = std::uint64_t{grid.column_count} * grid.row_count;
  if (in_slice > kMaxVoxels || in_slice * grid.slice_count > kMaxVoxels) {
    return std::unexpected(
        Status{StatusLevel::Error, "TooManyVoxels",
               "the grid has " + sizeText(grid) + ": at most " + std::to_string(kMaxVoxels) + " in all are drawn"});
  }
  const auto record = recordBytes(grid.fields);
  if (cells.layers.empty() && !cells.colors) {
    return malformedVoxels("none of its " + std::to_string(grid.fields.size()) + " fields has a known type");
  }
  const auto row = record ? extent(grid.column_count, grid.cell_stride, *record) : std::nullopt;
  const auto slice = row ? extent(grid.row_count, grid.row_stride, *row) : std::nullopt;
  const auto needed = slice ? extent(grid.slice_count, grid.slice_stride, *slice) : std::nullopt;
  const std::string strides = " with strides of " + std::to_string(grid.cell_stride) + ", " +
                              std::to_string(grid.row_stride) + " and " + std::to_string(grid.slice_stride) + " bytes";
  if (!needed) {
    return malformedVoxels("the voxels of " + sizeText(grid) + strides + " overlap");
  }
  if (*needed > grid.data.bytes.size()) {
    return malformedVoxels("the grid of " + sizeText(grid) + strides + " needs " + std::to_string(*needed) +
                           " bytes, it has " + std::to_string(grid.data.bytes.size()));
  }
  cells.all.points = static_cast<std::size_t>(in_slice * grid.slice_count);
  cells.all.point_step = grid.cell_stride;
  // Rows, slices and grids without padding are one run each.
  for (std::uint32_t z = 0; z < grid.slice_count; ++z) {
    for (std::uint32_t y = 0; y < grid.row_count; ++y) {
      const std::size_t offset = std::size_t{z} * grid.slice_stride + std::size_t{y} * grid.row_stride;
      if (!cells.all.runs.empty()) {
        PointRun& last = cells.all.runs.back();
        if (last.offset + last.count * grid.cell_stride == offset) {
          last.count += grid.column_count;
          continue;
        }
      }
      cells.all.runs.push_back({offset, grid.column_count});
    }
  }
  return cells;
}

}  // namespace stillframe::nodes
