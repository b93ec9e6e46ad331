#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/occupancy_grid/grid_tiles.h"
#include "nodes/occupancy_grid/grid_tracker.h"
#include "nodes/occupancy_grid/occupancy_grid_settings.h"
#include "scenegraph/layer.h"

namespace stillframe::nodes {

/// One topic of occupancy grids with the updates that belong to it (REQUIREMENTS C4).
///
/// A topic of updates alone can be given as well: its status says whose they are, or that there is no grid for them.
/// GUI thread.
class OccupancyGridLayer final : public scenegraph::Layer {
 public:
  [[nodiscard]] static std::unique_ptr<scenegraph::Layer> create(std::string_view topic);
  /// Updates without a grid (LayerType::takes).
  [[nodiscard]] static bool takesOrphan(const scenegraph::ObjectStore& store, const scenegraph::TopicInfo& topic);

  explicit OccupancyGridLayer(std::string_view topic);
  void attach(const scenegraph::LayerContext& context) override;
  void update(const scenegraph::Tick& tick) override;
  void detach() override;
  void setVisible(bool visible) override;
  [[nodiscard]] bool isVisible() const override { return visible_; }
  [[nodiscard]] const scenegraph::Status& status() const override { return status_; }
  /// "cells", of them "unknown", "occupied" (65 and more), "invalid" (outside -1..100); "updates" that went in.
  [[nodiscard]] scenegraph::LayerCounts counts() const override;
  [[nodiscard]] std::string sourceFrame() const override { return held_frame_.value_or(""); }
  [[nodiscard]] bool isPending() const override;
  [[nodiscard]] osg::BoundingBoxd boundsInFixed() const override { return bounds_; }
  [[nodiscard]] std::vector<scenegraph::SettingSpec> settingSpecs() const override;
  [[nodiscard]] scenegraph::SettingTexts settings() const override;
  std::expected<void, scenegraph::SettingError> applySettings(const scenegraph::SettingTexts& texts) override;

 private:
  using Placement = std::expected<tf::RigidTransform, tf::LookupFailure>;

  void clear();
  void hold(const std::optional<std::string>& frame);
  [[nodiscard]] Placement fixedFromGrid() const;
  [[nodiscard]] scenegraph::Status judge(const Placement& placement) const;

  std::string topic_;
  OccupancyGridSettings settings_;
  std::optional<OccupancyGridSettings> applied_;
  bool visible_ = true;
  scenegraph::Status status_;
  osg::BoundingBoxd bounds_;
  std::optional<scenegraph::LayerContext> context_;
  std::optional<GridTracker> tracker_;
  std::optional<GridTiles> tiles_;
  std::shared_ptr<const GridSnapshot> product_;  // shown
  std::optional<std::string> held_frame_;
};

}  // namespace stillframe::nodes
