#pragma once

#include <cstdint>
#include <memory>

#include "scenegraph/objects/voxel_grid.h"
#include "scenegraph/store/dataset.h"

namespace stillframe::bench {

/// A hilly floor with balls above it in side^3 voxels of 5 cm, as a mapper keeps it. Fields: "occupancy", UINT8, 0 or
/// 100; and where `with_noise`, "noisy", FLOAT32, the same with noise below 1: the same voxels are above 50, but no
/// neighbours are equal, so that the draw call has to go through all of them.
[[nodiscard]] scenegraph::VoxelGrid makeVoxels(std::uint32_t side, bool with_noise);

/// A dataset with that on "/voxels", in the frame "map".
[[nodiscard]] std::shared_ptr<scenegraph::Dataset> datasetOfVoxels(std::uint32_t side, bool with_noise);

}  // namespace stillframe::bench
