#pragma once

#include <memory>
#include <optional>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/ref_ptr>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/point_cloud/cloud_coloring.h"
#include "nodes/point_cloud/cloud_points.h"
#include "nodes/point_cloud/cloud_state.h"
#include "nodes/point_cloud/point_cloud_settings.h"
#include "scenegraph/layer.h"
#include "scenegraph/objects/object.h"
#include "scenegraph/sample_loader.h"

namespace stillframe::nodes {

/// Where a layer's points come from: what kind of message, and how one becomes a cloud.
struct CloudFeed {
  using Convert = scenegraph::SampleLoader<CloudPoints>::Convert;
  scenegraph::ObjectType type = scenegraph::ObjectType::PointCloud;
  std::string tag = "points";  ///< of the products in the cache
  Convert convert;             ///< runs on workers; captures values only
  PointCloudSettings defaults;
};

/// One topic of clouds as points (REQUIREMENTS C2); of anything else that becomes points, with its own CloudFeed.
///
/// Beneath the source frame's node lies one MatrixTransform, the cloud's pose and origin in double, and beneath it one
/// geometry. Colour, range and size are uniforms; another field is another array, converted on the GUI thread if the
/// worker did not foresee it. Arrays are uploaded when first drawn and freed from the GPU when another cloud is shown.
/// A tick at the same message costs two lookups. GUI thread.
class PointCloudLayer : public scenegraph::Layer {
 public:
  [[nodiscard]] static std::unique_ptr<scenegraph::Layer> create(std::string_view topic);

  PointCloudLayer(std::string_view topic, CloudFeed feed);
  ~PointCloudLayer() override;
  void attach(const scenegraph::LayerContext& context) override;
  void update(const scenegraph::Tick& tick) override;
  void detach() override;
  void setVisible(bool visible) override;
  [[nodiscard]] bool isVisible() const override { return visible_; }
  [[nodiscard]] const scenegraph::Status& status() const override { return status_; }
  /// "points" with finite coordinates, "dropped" without or left out by the feed, "bytes" of the cloud's data.
  [[nodiscard]] scenegraph::LayerCounts counts() const override;
  [[nodiscard]] std::string sourceFrame() const override { return held_frame_.value_or(""); }
  [[nodiscard]] bool isPending() const override;
  [[nodiscard]] osg::BoundingBoxd boundsInFixed() const override { return bounds_; }
  [[nodiscard]] std::vector<scenegraph::SettingSpec> settingSpecs() const override;
  [[nodiscard]] scenegraph::SettingTexts settings() const override;
  std::expected<void, scenegraph::SettingError> applySettings(const scenegraph::SettingTexts& texts) override;

 protected:
  /// What is drawn of a loaded sample, by default the sample itself. Called every tick, nullptr included; may start
  /// work and return what was there before as long as it is under way.
  [[nodiscard]] virtual std::shared_ptr<const CloudPoints> drawnOf(const std::shared_ptr<const CloudPoints>& loaded);
  /// What a layer that draws without a fault has to say besides.
  [[nodiscard]] virtual scenegraph::Status remark() const { return {}; }
  /// While attached; engaged once a sample is loaded.
  [[nodiscard]] const std::optional<scenegraph::LayerContext>& context() const { return context_; }
  [[nodiscard]] std::optional<scenegraph::Entry> loadedEntry() const;
  [[nodiscard]] const std::shared_ptr<const CloudPoints>& drawn() const { return product_; }
  [[nodiscard]] std::string sampleText() const;

 private:
  struct Foresight;
  using Placement = std::expected<tf::RigidTransform, tf::LookupFailure>;

  void clear();
  void show(std::shared_ptr<const CloudPoints> product);
  void hold(const std::optional<std::string>& frame);
  [[nodiscard]] Placement fixedFromPoints() const;
  void paint(const std::optional<tf::RigidTransform>& fixed_from_points);
  void setColorArrays();
  [[nodiscard]] scenegraph::Status judge(const Placement& placement) const;

  std::string topic_;
  CloudFeed feed_;
  PointCloudSettings settings_;
  std::optional<PointCloudSettings> applied_;
  bool visible_ = true;
  scenegraph::Status status_;
  osg::BoundingBoxd bounds_;
  std::optional<scenegraph::LayerContext> context_;
  std::shared_ptr<Foresight> foresight_;  // what workers prepare besides positions
  std::optional<scenegraph::SampleLoader<CloudPoints>> loader_;
  std::shared_ptr<const CloudPoints> product_;    // shown
  std::shared_ptr<const CloudPoints> reference_;  // first of the topic: choices and ranges
  ColorChoice choice_;
  std::optional<std::string> held_frame_;
  osg::ref_ptr<osg::MatrixTransform> node_;
  osg::ref_ptr<osg::Geometry> geometry_;
  CloudState state_;
};

}  // namespace stillframe::nodes
