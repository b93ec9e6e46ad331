#pragma once

#include <memory>
#include <optional>
#include <osg/Geometry>
#include <osg/PrimitiveSet>
#include <osg/ref_ptr>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/sample_layer.h"
#include "nodes/voxel_grid/voxel_block.h"
#include "nodes/voxel_grid/voxel_grid_settings.h"
#include "nodes/voxel_grid/voxel_rays.h"
#include "nodes/voxel_grid/voxel_state.h"

namespace stillframe::nodes {

/// One topic of dense voxel grids (REQUIREMENTS C5): the voxels that pass a test, coloured by a field, by their own
/// colours, by height, or flat.
///
/// Beneath the source frame's node lies one MatrixTransform, the grid's corner in double, and beneath it one geometry
/// of three quads, drawn in one call with an instance for each voxel that can be seen (exposedVoxels()). The shader
/// finds a voxel by its number, tests it, and leaves out sides that touch another drawn voxel. Test, range and colours
/// are uniforms: they upload nothing, and a tick costs the same for any number of voxels. GUI thread.
class VoxelGridLayer final : public SampleLayer<VoxelBlock, VoxelGridSettings> {
 public:
  [[nodiscard]] static std::unique_ptr<scenegraph::Layer> create(std::string_view topic);

  explicit VoxelGridLayer(std::string_view topic);
  /// "voxels" of the grid, "drawn" that pass the test, "listed" that the draw call goes through, "bytes" of the
  /// message's data.
  [[nodiscard]] scenegraph::LayerCounts counts() const override;
  [[nodiscard]] std::vector<scenegraph::SettingSpec> settingSpecs() const override;
  [[nodiscard]] std::optional<scenegraph::ColorLegend> legend() const override;
  [[nodiscard]] std::function<scenegraph::ValueHistogram()> histogramWork() const override;

 private:
  /// What the settings mean for one grid; empty names where there is none.
  struct Choice {
    std::string drawn_by;  ///< "": every voxel passes
    VoxelColorMode mode = VoxelColorMode::Flat;
    int axis = 2;
    std::string color;
    std::string missing;  ///< a field that the settings name and the grid has not
    friend bool operator==(const Choice&, const Choice&) = default;
  };
  [[nodiscard]] static Choice choose(const VoxelGridSettings& settings, const VoxelBlock& block);
  static void prepare(const VoxelBlock& block, const VoxelGridSettings& settings);
  [[nodiscard]] static VoxelTest testOf(const VoxelGridSettings& settings, const VoxelField* field);
  void open(const scenegraph::LayerContext& context) override;
  void close() override;
  void show() override;
  [[nodiscard]] std::optional<Anchor> load(const scenegraph::Tick& tick) override;
  [[nodiscard]] Anchor anchorOf(const VoxelBlock& block) const override;
  [[nodiscard]] std::optional<scenegraph::Picked> describeData(const scenegraph::PickHit& hit) const override;
  void draw(const Placement& fixed_from_grid) override;
  [[nodiscard]] osg::BoundingBoxd box() const override;
  [[nodiscard]] scenegraph::Status remark() const override;
  void build(const Choice& choice);
  [[nodiscard]] ValueRange fieldRange(const VoxelField& field) const;
  [[nodiscard]] ValueRange axisRange(const tf::RigidTransform& fixed_from_grid) const;

  std::optional<Choice> choice_;
  std::optional<ValueRange> range_;  // of the colours, where they are of values
  VoxelTest test_;
  std::size_t listed_ = 0;
  std::uint64_t buffer_texels_ = scenegraph::kUsualBufferTexels;
  std::uint64_t needed_texels_ = 0;  // of the largest buffer
  osg::ref_ptr<osg::Geometry> geometry_;
  osg::ref_ptr<VoxelRays> rays_;  // its user data: what a pick asks instead of drawing it
  VoxelState state_;
};

}  // namespace stillframe::nodes
