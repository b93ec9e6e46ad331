#pragma once

#include <memory>
#include <optional>
#include <osg/BoundingBox>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/ref_ptr>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/depth_image/camera_join.h"
#include "nodes/depth_image/color_join.h"
#include "nodes/depth_image/depth_frame.h"
#include "nodes/depth_image/depth_image_settings.h"
#include "nodes/depth_image/depth_state.h"
#include "nodes/points/value_range.h"
#include "scenegraph/layer.h"
#include "scenegraph/sample_loader.h"

namespace stillframe::nodes {

/// One topic of depth images as points (REQUIREMENTS C6), joined to the camera that took them.
///
/// The vertex shader multiplies each pixel's ray (an array per camera, shared) by its depth (an array per image), so a
/// new image uploads 4 bytes a pixel and a setting uploads nothing. A message whose encoding is none of depth is a
/// colour image: nothing is decoded, and the status says so (Info, NotDepth). GUI thread.
class DepthImageLayer final : public scenegraph::Layer {
 public:
  [[nodiscard]] static std::unique_ptr<scenegraph::Layer> create(std::string_view topic);

  explicit DepthImageLayer(std::string_view topic);
  ~DepthImageLayer() override;
  void attach(const scenegraph::LayerContext& context) override;
  void update(const scenegraph::Tick& tick) override;
  void detach() override;
  void setVisible(bool visible) override;
  [[nodiscard]] bool isVisible() const override { return visible_; }
  [[nodiscard]] const scenegraph::Status& status() const override { return status_; }
  /// "points" drawn, "holes" without a depth, "left_out" with one (too far, or without a ray), "bytes" of the
  /// message's data, "residual_npx": the largest error of the rectification in 1e-9 pixels.
  [[nodiscard]] scenegraph::LayerCounts counts() const override;
  [[nodiscard]] std::string sourceFrame() const override { return held_frame_.value_or(""); }
  [[nodiscard]] bool isPending() const override;
  [[nodiscard]] osg::BoundingBoxd boundsInFixed() const override { return bounds_; }
  [[nodiscard]] std::vector<scenegraph::SettingSpec> settingSpecs() const override;
  [[nodiscard]] scenegraph::SettingTexts settings() const override;
  std::expected<void, scenegraph::SettingError> applySettings(const scenegraph::SettingTexts& texts) override;

 private:
  /// What is drawn: a depth image with its rays and colours; without rays nothing is.
  struct Shown {
    std::shared_ptr<const DepthFrame> depth;
    std::shared_ptr<const CameraRays> rays;
    std::shared_ptr<const ColorFrame> colors;
    friend bool operator==(const Shown&, const Shown&) = default;
  };
  /// Drawn points and their box in the optical frame.
  struct Extent {
    std::size_t points = 0;
    osg::BoundingBox box;
  };
  /// The percentiles asked for last.
  struct Percentiles {
    [[nodiscard]] ValueRange of(const std::shared_ptr<const DepthFrame>& frame, double low, double high);
    std::shared_ptr<const DepthFrame> of_frame;
    double of_low = 0.0;
    double of_high = 0.0;
    ValueRange range;
  };
  using Placement = std::expected<tf::RigidTransform, tf::LookupFailure>;

  void clear();
  /// nullopt while a part of it is under way.
  [[nodiscard]] std::optional<Shown> join(tf::TimePoint time);
  void show(Shown shown);
  void measure();
  void hold(const std::optional<std::string>& frame);
  void paint();
  [[nodiscard]] scenegraph::Status judge(const Placement& placement) const;

  std::string topic_;
  DepthImageSettings settings_;
  std::optional<DepthImageSettings> applied_;
  bool visible_ = true;
  scenegraph::Status status_;
  scenegraph::Status join_status_;  // of the camera or the colours
  osg::BoundingBoxd bounds_;
  std::optional<scenegraph::LayerContext> context_;
  std::optional<scenegraph::SampleLoader<DepthFrame>> loader_;
  std::optional<CameraJoin> camera_;
  std::optional<ColorJoin> color_;
  Shown shown_;
  bool is_joining_ = false;
  Extent extent_;
  std::optional<float> measured_limit_;
  std::shared_ptr<const DepthFrame> reference_;  // first of the topic: ranges
  Percentiles percentiles_;
  std::optional<std::string> held_frame_;
  osg::ref_ptr<osg::MatrixTransform> node_;
  osg::ref_ptr<osg::Geometry> geometry_;
  DepthState state_;
};

}  // namespace stillframe::nodes
