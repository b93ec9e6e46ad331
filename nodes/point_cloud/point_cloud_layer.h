#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <osg/Geometry>
#include <osg/ref_ptr>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/point_cloud/cloud_coloring.h"
#include "nodes/point_cloud/cloud_points.h"
#include "nodes/point_cloud/cloud_state.h"
#include "nodes/point_cloud/point_cloud_settings.h"
#include "nodes/sample_layer.h"
#include "scenegraph/latest_job.h"
#include "scenegraph/objects/object.h"

namespace stillframe::nodes {

/// Where a layer's points come from: what kind of message, and how one becomes a cloud.
struct CloudFeed {
  using Cloud = std::expected<std::shared_ptr<const scenegraph::PointCloud>, scenegraph::Status>;
  scenegraph::ObjectType type = scenegraph::ObjectType::PointCloud;
  std::string tag = "points";  ///< of the products in the cache
  /// Runs on workers; captures values only.
  std::function<std::expected<CloudPoints, scenegraph::Status>(const scenegraph::AnyObject&, const PointCloudSettings&)>
      convert;
  std::function<void(CloudPoints&, const scenegraph::MessageOrigin&)> settle;  ///< the same; empty: messages stay
  PointCloudSettings defaults;
};

/// Of messages that hold a cloud, which `read` finds in them: they are not kept.
[[nodiscard]] CloudFeed feedOf(scenegraph::ObjectType type,
                               const std::function<CloudFeed::Cloud(const scenegraph::AnyObject&)>& read);

/// One topic of clouds as points (REQUIREMENTS C2); of anything else that becomes points, with its own CloudFeed.
///
/// Beneath the source frame's node lies one MatrixTransform, the cloud's pose and origin in double, and beneath it one
/// geometry. Colour, range and size are uniforms; another field is another array, of large clouds converted on a worker
/// while the colours stay what they were. Arrays are uploaded when first drawn and freed from the GPU when another
/// cloud is shown. A tick at the same message costs two lookups. GUI thread.
class PointCloudLayer : public SampleLayer<CloudPoints, PointCloudSettings> {
 public:
  [[nodiscard]] static std::unique_ptr<scenegraph::Layer> create(std::string_view topic);

  PointCloudLayer(std::string_view topic, CloudFeed feed);
  /// "points" with finite coordinates, "dropped" without or left out by the feed, "bytes" of the cloud's data.
  [[nodiscard]] scenegraph::LayerCounts counts() const override;
  [[nodiscard]] std::vector<scenegraph::SettingSpec> settingSpecs() const override;
  [[nodiscard]] std::optional<scenegraph::ColorLegend> legend() const override;
  [[nodiscard]] std::function<scenegraph::ValueHistogram()> histogramWork() const override;

 protected:
  void open(const scenegraph::LayerContext& context) override;
  void close() override;
  void show() override;
  [[nodiscard]] std::optional<scenegraph::Picked> describeData(const scenegraph::PickHit& hit) const override;
  [[nodiscard]] Anchor anchorOf(const CloudPoints& cloud) const override;
  void draw(const Placement& fixed_from_points) override;
  [[nodiscard]] osg::BoundingBoxd box() const override;
  [[nodiscard]] osg::BoundingBoxd bulk() const override;
  [[nodiscard]] scenegraph::Status remark() const final;
  [[nodiscard]] bool isWorking() const override;
  /// What a layer that draws without a fault has to say besides.
  [[nodiscard]] virtual scenegraph::Status feedRemark() const { return {}; }

 private:
  /// Whose colours are being made ready.
  struct ColorWork {
    Shown cloud;
    Shown reference;
    ColorChoice choice;
    PointCloudSettings settings;
    friend bool operator==(const ColorWork&, const ColorWork&) = default;
  };
  [[nodiscard]] bool hasColorsFor(const ColorChoice& choice);
  void setColorArrays();

  std::optional<scenegraph::LatestJob<CloudPoints>> color_job_;
  std::optional<ColorWork> color_work_;
  std::uint64_t color_jobs_ = 0;
  ColorChoice choice_;
  PointCloudSettings ranged_;             // the settings that the range goes by
  Shown colored_by_;                      // the reference that it goes by
  std::optional<ValueRange> range_;       // of the colours, where they are of values
  tf::RigidTransform fixed_from_points_;  // that x, y, z are coloured by
  osg::ref_ptr<osg::Geometry> geometry_;
  CloudState state_;
};

}  // namespace stillframe::nodes
