#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <osg/StateSet>
#include <osg/Uniform>
#include <osg/ref_ptr>

#include "nodes/coloring_state.h"
#include "nodes/points/value_range.h"
#include "nodes/voxel_grid/voxel_block.h"
#include "nodes/voxel_grid/voxel_grid_settings.h"

namespace stillframe::nodes {

/// What the voxels take their colour from; the numbers are the shader's.
enum class VoxelColorMode : std::uint8_t { Flat = 0, Rgb = 1, Value = 2, Axis = 3 };

/// What the shader reads of one grid.
struct VoxelBuffers {
  const VoxelField* drawn_by = nullptr;    ///< nullptr: every voxel passes
  const VoxelField* colored_by = nullptr;  ///< with VoxelColorMode::Value
  const VoxelColors* colors = nullptr;     ///< with VoxelColorMode::Rgb
  const VoxelList* list = nullptr;

  /// Texels of the largest of them.
  [[nodiscard]] std::size_t largest() const;
};

/// Program, buffers and uniforms of one layer of voxel grids. GUI thread.
class VoxelState {
 public:
  VoxelState();
  [[nodiscard]] osg::StateSet* stateSet() const noexcept { return state_.get(); }

  /// Textures of another grid or of other fields.
  void setBuffers(const VoxelBlock& block, const VoxelBuffers& buffers);
  void clearBuffers();
  /// `is_translucent`: the colours' own alpha counts.
  void apply(const VoxelGridSettings& settings, bool is_translucent);
  void setTest(const VoxelTest& test);
  /// t = value * scale + bias of the stored values.
  void setColor(VoxelColorMode mode, const RangeMap& map);
  /// t = dot(coefficients.xyz, centre) + coefficients.w.
  void setAxisMap(const glm::dvec4& coefficients);

 private:
  osg::ref_ptr<osg::StateSet> state_;
  ColoringState coloring_;
  osg::ref_ptr<osg::Uniform> is_listed_;
  osg::ref_ptr<osg::Uniform> voxels_;
  osg::ref_ptr<osg::Uniform> cell_size_;
  osg::ref_ptr<osg::Uniform> drawn_form_;
  osg::ref_ptr<osg::Uniform> colored_form_;
  osg::ref_ptr<osg::Uniform> test_;
  osg::ref_ptr<osg::Uniform> axis_;
  osg::ref_ptr<osg::Uniform> shading_;
  osg::ref_ptr<osg::Uniform> opacity_;
};

}  // namespace stillframe::nodes
