#pragma once

#include <memory>

#include "nodes/voxel_grid/voxel_block.h"
#include "scenegraph/pick/ray_target.h"

namespace stillframe::nodes {

/// Which voxel of a grid a line of sight shows: from cell to cell along the ray, by the rules of the shader (which side
/// faces the eye, what hides a side), in double. As many steps as the ray crosses cells, some nanoseconds each, however
/// many voxels there are. GUI thread.
class VoxelRays final : public scenegraph::RayTarget {
 public:
  /// What the shader has: voxels that pass a test over `drawn_by` ("": all), with the colours' alpha or without, as
  /// instances of the list for these.
  VoxelRays(std::shared_ptr<const VoxelBlock> block, std::string_view drawn_by, bool with_colors);
  void setTest(const VoxelTest& test) { test_ = test; }
  /// False: what has no opacity is not seen.
  void setSeen(bool is_seen) { is_seen_ = is_seen; }

  [[nodiscard]] std::optional<Hit> meet(const scenegraph::PickRay& ray) const override;

 private:
  /// Alpha of the voxel where it is drawn, else 0.
  [[nodiscard]] std::uint32_t alphaOf(std::size_t voxel) const;
  [[nodiscard]] std::optional<std::uint32_t> instanceOf(std::size_t voxel) const;

  std::shared_ptr<const VoxelBlock> block_;
  const VoxelField* drawn_by_;
  const VoxelColors* colors_;
  const VoxelList& list_;
  VoxelTest test_;
  bool is_seen_ = true;
};

}  // namespace stillframe::nodes
