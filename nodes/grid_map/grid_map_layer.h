#pragma once

#include <memory>
#include <optional>
#include <osg/Geometry>
#include <osg/ref_ptr>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/grid_map/grid_map_settings.h"
#include "nodes/grid_map/grid_map_state.h"
#include "nodes/grid_map/grid_surface.h"
#include "nodes/sample_layer.h"

namespace stillframe::nodes {

/// One topic of grid maps (REQUIREMENTS C11): a surface by one layer of the map, or a level picture, coloured by
/// another.
///
/// Beneath the source frame's node lies one MatrixTransform, the map's corner in double, and beneath it one geometry:
/// a triangle mesh through the centres of the cells that have a height, or one quad over all cells. Colours come from
/// a texture with a texel a cell, so that another colour layer changes no geometry. Layers that the settings name are
/// converted on a worker with the map; one chosen later is converted when it is first drawn. GUI thread.
class GridMapLayer final : public SampleLayer<GridSurface, GridMapSettings> {
 public:
  [[nodiscard]] static std::unique_ptr<scenegraph::Layer> create(std::string_view topic);

  explicit GridMapLayer(std::string_view topic);
  /// "cells" of the map, "triangles" drawn, "bytes" of the message's data.
  [[nodiscard]] scenegraph::LayerCounts counts() const override;
  [[nodiscard]] std::vector<scenegraph::SettingSpec> settingSpecs() const override;
  [[nodiscard]] std::optional<scenegraph::ColorLegend> legend() const override;
  [[nodiscard]] std::function<scenegraph::ValueHistogram()> histogramWork() const override;

 private:
  /// What the settings mean for one map; empty names where there is none.
  struct Choice {
    std::string height;  ///< "": level
    MapColorMode mode = MapColorMode::Flat;
    std::string color;
    std::string missing;  ///< a layer that the settings name and the map has not
    friend bool operator==(const Choice&, const Choice&) = default;
  };
  [[nodiscard]] static Choice choose(const GridMapSettings& settings, const GridSurface& map);
  static void prepare(const GridSurface& map, const GridMapSettings& settings);
  void open(const scenegraph::LayerContext& context) override;
  void close() override;
  void show() override;
  [[nodiscard]] std::optional<Anchor> load(const scenegraph::Tick& tick) override;
  [[nodiscard]] Anchor anchorOf(const GridSurface& map) const override;
  [[nodiscard]] std::optional<scenegraph::Picked> describeData(const scenegraph::PickHit& hit) const override;
  void draw(const Placement& fixed_from_data) override;
  [[nodiscard]] osg::BoundingBoxd box() const override { return box_; }
  [[nodiscard]] scenegraph::Status remark() const override;
  void build(const Choice& choice);
  void paint();

  std::optional<Choice> choice_;
  std::optional<ValueRange> range_;  // of the colours, where they are of values
  float flat_step_ = 1.0F;           // where it lies when flat
  osg::BoundingBoxd box_;            // of what is drawn, in the map's own frame
  std::size_t triangles_ = 0;
  osg::ref_ptr<osg::Geometry> geometry_;
  GridMapState state_;
};

}  // namespace stillframe::nodes
