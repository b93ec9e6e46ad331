#pragma once

#include <memory>
#include <optional>
#include <osg/BoundingBox>
#include <osg/Geometry>
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
#include "nodes/sample_layer.h"

namespace stillframe::nodes {

/// One topic of depth images as points (REQUIREMENTS C6), joined to the camera that took them.
///
/// The vertex shader multiplies each pixel's ray (an array per camera, shared) by its depth (an array per image), so a
/// new image uploads 4 bytes a pixel and a setting uploads nothing. A message whose encoding is none of depth is a
/// colour image: nothing is decoded, and the status says so (Info, NotDepth). GUI thread.
class DepthImageLayer final : public SampleLayer<DepthFrame, DepthImageSettings> {
 public:
  [[nodiscard]] static std::unique_ptr<scenegraph::Layer> create(std::string_view topic);

  explicit DepthImageLayer(std::string_view topic);
  /// "points" drawn, "holes" without a depth, "left_out" with one (too far, or without a ray), "bytes" of the
  /// message's data, "residual_npx": the largest error of the rectification in 1e-9 pixels.
  [[nodiscard]] scenegraph::LayerCounts counts() const override;
  [[nodiscard]] std::vector<scenegraph::SettingSpec> settingSpecs() const override;
  [[nodiscard]] std::optional<scenegraph::ColorLegend> legend() const override;
  [[nodiscard]] std::function<scenegraph::ValueHistogram()> histogramWork() const override;

 private:
  /// What is drawn: a depth image with its rays and colours; without rays nothing is.
  struct Joined {
    std::shared_ptr<const DepthFrame> depth;
    std::shared_ptr<const CameraRays> rays;
    std::shared_ptr<const ColorFrame> colors;
    friend bool operator==(const Joined&, const Joined&) = default;
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

  void open(const scenegraph::LayerContext& context) override;
  void close() override;
  void clear() override;
  [[nodiscard]] std::optional<Anchor> load(const scenegraph::Tick& tick) override;
  void show() override {}  // load() joins and shows
  [[nodiscard]] Anchor anchorOf(const DepthFrame& frame) const override;
  [[nodiscard]] std::optional<scenegraph::Picked> describeData(const scenegraph::PickHit& hit) const override;
  void draw(const Placement& fixed_from_data) override;
  [[nodiscard]] osg::BoundingBoxd box() const override;
  [[nodiscard]] scenegraph::Status remark() const override;
  [[nodiscard]] bool isWorking() const override;
  /// nullopt while a part of it is under way.
  [[nodiscard]] std::optional<Joined> join(tf::TimePoint time);
  void show(Joined shown);
  void measure();

  scenegraph::Status join_status_;  // of the camera or the colours
  std::optional<CameraJoin> camera_;
  std::optional<ColorJoin> color_;
  Joined shown_;
  bool is_joining_ = false;
  Extent extent_;
  std::optional<float> measured_limit_;
  Percentiles percentiles_;
  std::optional<ValueRange> range_;  // of the colours, where they are of depths
  osg::ref_ptr<osg::Geometry> geometry_;
  DepthState state_;
};

}  // namespace stillframe::nodes
