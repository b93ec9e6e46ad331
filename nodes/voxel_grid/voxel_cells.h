#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>

#include "nodes/points/packed_cells.h"
#include "scenegraph/objects/voxel_grid.h"
#include "scenegraph/status.h"

namespace stillframe::nodes {

/// Voxels in all, so that memory stays bounded. What the driver has room for is asked of it (Tick::buffer_texels).
inline constexpr std::uint64_t kMaxVoxels = std::uint64_t{1} << 27;

/// The voxels of a grid whose sizes fit its data, x fastest, then y, then z.
///
/// "MalformedGrid": cell size or origin make no sense, voxels overlap, the data is too short, or no field is known;
/// "TooManyVoxels". A grid without voxels is well-formed. Since voxels do not overlap, what is made of them is bounded
/// by the size of the message. The bytes stay those of `grid`, which must outlive the result.
[[nodiscard]] std::expected<PackedCells, scenegraph::Status> readVoxelCells(const scenegraph::VoxelGrid& grid);

}  // namespace stillframe::nodes
