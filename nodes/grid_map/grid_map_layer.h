#pragma once

#include <memory>
#include <optional>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/ref_ptr>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/grid_map/grid_map_settings.h"
#include "nodes/grid_map/grid_map_state.h"
#include "nodes/grid_map/grid_surface.h"
#include "scenegraph/layer.h"
#include "scenegraph/sample_loader.h"

namespace stillframe::nodes {

/// One topic of grid maps (REQUIREMENTS C11): a surface by one layer of the map, or a level picture, coloured by
/// another.
///
/// Beneath the source frame's node lies one MatrixTransform, the map's corner in double, and beneath it one geometry:
/// a triangle mesh through the centres of the cells that have a height, or one quad over all cells. Colours come from
/// a texture with a texel a cell, so that another colour layer changes no geometry. Layers that the settings name are
/// converted on a worker with the map; one chosen later is converted when it is first drawn. GUI thread.
class GridMapLayer final : public scenegraph::Layer {
 public:
  [[nodiscard]] static std::unique_ptr<scenegraph::Layer> create(std::string_view topic);

  explicit GridMapLayer(std::string_view topic);
  ~GridMapLayer() override;
  void attach(const scenegraph::LayerContext& context) override;
  void update(const scenegraph::Tick& tick) override;
  void detach() override;
  void setVisible(bool visible) override;
  [[nodiscard]] bool isVisible() const override { return visible_; }
  [[nodiscard]] const scenegraph::Status& status() const override { return status_; }
  /// "cells" of the map, "triangles" drawn, "bytes" of the message's data.
  [[nodiscard]] scenegraph::LayerCounts counts() const override;
  [[nodiscard]] std::string sourceFrame() const override { return held_frame_.value_or(""); }
  [[nodiscard]] bool isPending() const override { return visible_ && loader_ && loader_->isPending(); }
  [[nodiscard]] osg::BoundingBoxd boundsInFixed() const override { return bounds_; }
  [[nodiscard]] std::vector<scenegraph::SettingSpec> settingSpecs() const override;
  [[nodiscard]] scenegraph::SettingTexts settings() const override;
  std::expected<void, scenegraph::SettingError> applySettings(const scenegraph::SettingTexts& texts) override;

 private:
  struct Foresight;
  /// What the settings mean for one map; empty names where there is none.
  struct Choice {
    std::string height;  ///< "": level
    MapColorMode mode = MapColorMode::Flat;
    std::string color;
    std::string missing;  ///< a layer that the settings name and the map has not
    friend bool operator==(const Choice&, const Choice&) = default;
  };
  [[nodiscard]] static Choice choose(const GridMapSettings& settings, const GridSurface& map);
  void clear();
  void show(std::shared_ptr<const GridSurface> product);
  void build(const Choice& choice);
  void paint();
  void hold(const std::optional<std::string>& frame);
  [[nodiscard]] scenegraph::Status judge() const;

  std::string topic_;
  GridMapSettings settings_;
  bool visible_ = true;
  scenegraph::Status status_;
  osg::BoundingBoxd bounds_;
  std::optional<scenegraph::LayerContext> context_;
  std::shared_ptr<Foresight> foresight_;
  std::optional<scenegraph::SampleLoader<GridSurface>> loader_;
  std::shared_ptr<const GridSurface> product_;    // shown
  std::shared_ptr<const GridSurface> reference_;  // first of the topic: ranges
  std::optional<Choice> choice_;
  std::optional<GridMapSettings> applied_;  // to state_, for choice_
  osg::BoundingBoxd box_;                   // of what is drawn, in the map's own frame
  std::size_t triangles_ = 0;
  std::optional<std::string> held_frame_;
  osg::ref_ptr<osg::MatrixTransform> node_;
  osg::ref_ptr<osg::Geometry> geometry_;
  GridMapState state_;
};

}  // namespace stillframe::nodes
