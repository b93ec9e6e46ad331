#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "nodes/poses/pose_set.h"
#include "nodes/poses/pose_shapes.h"
#include "nodes/poses/pose_trail.h"
#include "nodes/poses/poses_settings.h"
#include "nodes/sample_layer.h"

namespace stillframe::nodes {

/// What is drawn of a sample: its poses, and the trail that leads to them.
struct ShownPoses {
  std::shared_ptr<const PoseSet> poses;
  std::shared_ptr<const PoseTrail> trail;  ///< nullptr without

  [[nodiscard]] std::size_t byteSize() const { return sizeof(*this) + poses->byteSize(); }
  void releaseGlObjects() const {
    poses->releaseGlObjects();
    if (trail != nullptr) {
      trail->poses.releaseGlObjects();
    }
  }
};

/// One topic of poses: an array, a path, a single pose with or without covariance, a point or a polygon (REQUIREMENTS
/// C8). Copies of shapes go into one draw call a kind, lines into one; see PoseShapes. A trail is made of the messages
/// before the one in force, not of those that were visited. GUI thread.
class PosesLayer final : public SampleLayer<ShownPoses, PosesSettings> {
 public:
  [[nodiscard]] static std::unique_ptr<scenegraph::Layer> create(std::string_view topic);

  explicit PosesLayer(std::string_view topic);
  /// "poses" of the message, "shapes" and line "segments" drawn, "trail" poses, and "dropped" ones that cannot be
  /// drawn.
  [[nodiscard]] scenegraph::LayerCounts counts() const override;
  [[nodiscard]] std::optional<scenegraph::ColorLegend> legend() const override;
  [[nodiscard]] std::function<scenegraph::ValueHistogram()> histogramWork() const override;

 private:
  void open(const scenegraph::LayerContext& context) override;
  void close() override;
  void clear() override;
  void show() override;
  [[nodiscard]] std::optional<Anchor> load(const scenegraph::Tick& tick) override;
  [[nodiscard]] Shown drawnOf(const Shown& loaded) override;
  [[nodiscard]] Anchor anchorOf(const ShownPoses& shown) const override;
  [[nodiscard]] std::optional<scenegraph::Picked> describeData(const scenegraph::PickHit& hit) const override;
  void draw(const Placement& fixed_from_data) override;
  [[nodiscard]] osg::BoundingBoxd box() const override { return shapes_->box(); }
  [[nodiscard]] scenegraph::Status remark() const override;
  [[nodiscard]] const scenegraph::Status& sourceStatus() const override;
  [[nodiscard]] bool isWorking() const override;

  std::optional<PoseShapes> shapes_;
  std::optional<TrailLoader> trails_;
  std::shared_ptr<const PoseTrail> trail_;  // of drawn_
  Shown loaded_;                            // that drawn_ was made of
  Shown drawn_;
  scenegraph::Status trail_status_;
  std::uint64_t buffer_texels_ = scenegraph::kUsualBufferTexels;
};

}  // namespace stillframe::nodes
