#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/occupancy_grid/grid_tiles.h"
#include "nodes/occupancy_grid/grid_tracker.h"
#include "nodes/occupancy_grid/occupancy_grid_settings.h"
#include "nodes/topic_layer.h"

namespace stillframe::nodes {

/// One topic of occupancy grids with the updates that belong to it (REQUIREMENTS C4).
///
/// A topic of updates alone can be given as well: its status says whose they are, or that there is no grid for them.
/// GUI thread.
class OccupancyGridLayer final : public TopicLayer {
 public:
  [[nodiscard]] static std::unique_ptr<scenegraph::Layer> create(std::string_view topic);
  /// Updates without a grid (LayerType::takes).
  [[nodiscard]] static bool takesOrphan(const scenegraph::ObjectStore& store, const scenegraph::TopicInfo& topic);

  explicit OccupancyGridLayer(std::string_view topic);
  /// "cells", of them "unknown", "occupied" (65 and more), "invalid" (outside -1..100); "updates" that went in.
  [[nodiscard]] scenegraph::LayerCounts counts() const override;
  [[nodiscard]] std::optional<scenegraph::ColorLegend> legend() const override;
  [[nodiscard]] std::vector<scenegraph::SettingSpec> settingSpecs() const override;
  [[nodiscard]] scenegraph::SettingTexts settings() const override;

 private:
  std::expected<void, scenegraph::SettingError> changeSettings(const scenegraph::SettingTexts& texts) override;
  void open(const scenegraph::LayerContext& context) override;
  void close() override;
  void clear() override;
  [[nodiscard]] std::optional<Anchor> load(const scenegraph::Tick& tick) override;
  [[nodiscard]] std::optional<scenegraph::Picked> describeData(const scenegraph::PickHit& hit) const override;
  void draw(const Placement& fixed_from_data) override;
  [[nodiscard]] osg::BoundingBoxd box() const override;
  [[nodiscard]] const scenegraph::Status& sourceStatus() const override { return tracker_->status(); }
  [[nodiscard]] scenegraph::Status remark() const override;
  [[nodiscard]] bool isWorking() const override { return tracker_->isPending(); }

  OccupancyGridSettings settings_;
  std::optional<OccupancyGridSettings> applied_;
  std::optional<GridTracker> tracker_;
  std::optional<GridTiles> tiles_;
  std::shared_ptr<const GridSnapshot> product_;  // shown
};

}  // namespace stillframe::nodes
