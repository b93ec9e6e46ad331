#pragma once

#include <cstddef>
#include <expected>
#include <glm/vec3.hpp>
#include <memory>
#include <osg/Array>
#include <osg/TextureBuffer>
#include <osg/ref_ptr>
#include <string_view>

#include "nodes/points/value_range.h"
#include "nodes/voxel_grid/voxel_cells.h"
#include "nodes/voxel_grid/voxel_values.h"

namespace stillframe::nodes {

/// 32-bit words behind a texture buffer. An osg::Array, because OSG 3.6.5 loses an Image there in .osgt.
struct VoxelWords {
  osg::ref_ptr<osg::UIntArray> words;
  osg::ref_ptr<osg::TextureBuffer> texture;

  static VoxelWords make(std::size_t count);
  [[nodiscard]] std::span<std::uint32_t> span() const { return {words->asVector().data(), words->size()}; }
  void releaseGlObjects() const;
};

/// A field as it is uploaded.
struct VoxelField {
  ChannelInfo info;
  VoxelFormat format;
  ChannelValues limits;
  VoxelWords values;
};

/// Colours as they are uploaded: R, G, B, A in increasing bytes, one word a voxel.
struct VoxelColors {
  VoxelWords values;
  bool is_translucent = false;  ///< some alpha is neither 0 nor 255
};

/// Which voxels the draw call goes through.
struct VoxelList {
  VoxelWords values;       ///< their numbers; empty when it goes through all
  std::size_t voxels = 0;  ///< instances of the call
};

/// A voxel grid in the form that is drawn: checked now, fields, colours and lists made when first asked for.
///
/// Made on a worker, cached, shared by all views. field(), colors(), list(), drawn() and percentiles() convert on first
/// use and remember; any thread may call them. What they point to is valid as long as this.
class VoxelBlock {
 public:
  [[nodiscard]] static std::expected<VoxelBlock, scenegraph::Status> make(
      std::shared_ptr<const scenegraph::VoxelGrid> grid);
  VoxelBlock(VoxelBlock&&) noexcept;
  VoxelBlock& operator=(VoxelBlock&&) noexcept;
  ~VoxelBlock();

  [[nodiscard]] const scenegraph::VoxelGrid& source() const noexcept { return *grid_; }
  [[nodiscard]] const PackedCells& cells() const noexcept { return cells_; }
  [[nodiscard]] std::size_t voxels() const noexcept { return cells_.all.points; }
  [[nodiscard]] glm::uvec3 count() const noexcept {
    return {grid_->column_count, grid_->row_count, grid_->slice_count};
  }
  [[nodiscard]] bool hasField(std::string_view name) const;

  /// nullptr when there is none of that name, or no voxel.
  [[nodiscard]] const VoxelField* field(std::string_view name) const;
  /// nullptr without colours.
  [[nodiscard]] const VoxelColors* colors() const;
  /// The voxels that a rule over `field` ("": none) can show, with the colours' alpha or without.
  [[nodiscard]] const VoxelList& list(std::string_view field, bool with_colors) const;
  /// Voxels that pass a test over a field, with the colours those that have some alpha. The first time O(voxels), then
  /// remembered for the test asked for last.
  [[nodiscard]] std::size_t drawn(std::string_view field, const VoxelTest& test, bool with_colors) const;
  [[nodiscard]] ValueRange percentiles(std::string_view field, double low, double high) const;

  /// Frees what is on the GPU, in every context. GUI thread.
  void releaseGlObjects() const;
  /// Payload and what has been made of it so far.
  [[nodiscard]] std::size_t byteSize() const noexcept;

 private:
  struct Lazy;
  VoxelBlock();
  [[nodiscard]] const VoxelField* fieldLocked(std::string_view name) const;
  [[nodiscard]] const VoxelColors* colorsLocked() const;

  std::shared_ptr<const scenegraph::VoxelGrid> grid_;
  PackedCells cells_;
  std::unique_ptr<Lazy> lazy_;
};

}  // namespace stillframe::nodes
