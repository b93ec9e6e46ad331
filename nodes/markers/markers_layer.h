#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/markers/marker_picture.h"
#include "nodes/markers/markers_settings.h"
#include "nodes/markers/model_shelf.h"
#include "nodes/markers/scene_tracker.h"
#include "scenegraph/layer.h"

namespace stillframe::nodes {

/// One topic of markers (REQUIREMENTS C7, D2): visualization_msgs Marker and MarkerArray, foxglove.SceneUpdate.
///
/// Entities lie in frames of their own, so the layer hangs beneath as many frames as they name. They are always carried
/// along by their frame (D1); where that differs from what a marker asks for, the status says so. A tick costs what
/// changed. GUI thread.
class MarkersLayer final : public scenegraph::Layer {
 public:
  [[nodiscard]] static std::unique_ptr<scenegraph::Layer> create(std::string_view topic);

  explicit MarkersLayer(std::string_view topic) : topic_(topic) {}
  void attach(const scenegraph::LayerContext& context) override;
  void update(const scenegraph::Tick& tick) override;
  void detach() override;
  [[nodiscard]] bool isVisible() const override { return visible_; }
  [[nodiscard]] const scenegraph::Status& status() const override { return status_; }
  /// "entities" and their "primitives", "hidden" entities of namespaces that are switched off, "draw_calls".
  [[nodiscard]] scenegraph::LayerCounts counts() const override;
  /// The first of the frames by name.
  [[nodiscard]] std::string sourceFrame() const override;
  [[nodiscard]] bool isPending() const override {
    return visible_ && tracker_ && (tracker_->isPending() || shelf_->isPending());
  }
  [[nodiscard]] osg::BoundingBoxd boundsInFixed() const override { return bounds_; }
  /// An entity, where one of its primitives is hit.
  [[nodiscard]] std::optional<scenegraph::Picked> describe(const scenegraph::PickHit& hit) const override {
    return visible_ && picture_ ? picture_->describe(hit) : std::nullopt;
  }
  void collectNodes(std::vector<osg::Node*>& nodes) const override;
  [[nodiscard]] std::vector<scenegraph::SettingSpec> settingSpecs() const override;
  [[nodiscard]] scenegraph::SettingTexts settings() const override;

 private:
  void changeVisible(bool visible) override;
  std::expected<void, scenegraph::SettingError> changeSettings(const scenegraph::SettingTexts& texts) override;
  void clear();
  [[nodiscard]] scenegraph::Status judge(tf::TimePoint time) const;
  [[nodiscard]] scenegraph::Status remark(tf::TimePoint time) const;
  [[nodiscard]] std::optional<std::string> movedFrame(tf::TimePoint time) const;

  std::string topic_;
  MarkersSettings settings_;
  bool visible_ = true;
  scenegraph::Status status_;
  osg::BoundingBoxd bounds_;
  std::optional<scenegraph::LayerContext> context_;
  std::optional<SceneTracker> tracker_;
  std::optional<MarkerPicture> picture_;
  std::optional<ModelShelf> shelf_;
  std::uint64_t buffer_texels_ = scenegraph::kUsualBufferTexels;
};

}  // namespace stillframe::nodes
