#pragma once

#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <osg/Group>
#include <string>
#include <vector>

#include "scenegraph/camera/camera.h"
#include "scenegraph/pipeline/offscreen_context.h"
#include "scenegraph/pipeline/view_pipeline.h"
#include "scenegraph/settings.h"
#include "scenegraph/status.h"

namespace stillframe::scenegraph {

/// A picture as it left the last pass: linear light, top row first.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<float> rgba;                    ///< scene-linear, 4 a pixel; alpha is 1, since the background is opaque
  std::vector<float> depth_m;                 ///< metres along the view axis; +infinity where nothing was drawn
  std::vector<float> normals = {};            ///< on request: 3 a pixel, in the fixed frame; 0 where nothing was drawn
  std::vector<std::uint32_t> layer_ids = {};  ///< on request: place in layer_names, from 1; 0 where nothing was drawn
  std::vector<std::string> layer_names = {};  ///< of layer_ids
};

/// How large, on what, and through which passes.
struct RenderOptions {
  int width = 1280;
  int height = 720;
  Color background{.r = 0.12F, .g = 0.13F, .b = 0.15F, .a = 1.0F};
  PostChain post = {};
  PointWay points = PointWay::Auto;  ///< who draws opaque points
  int most_sorted = kMostSorted;     ///< blended fragments of a sample that are put in order (ViewPipeline)
  PointLimits point_limits = {};     ///< how many of them, where that is not OpenGL
};

/// What the last render() did and took, in milliseconds of wall time with the GPU drained.
struct FrameStatistics {
  double frame_ms = 0.0;      ///< culling and drawing
  double cpu_ms = 0.0;        ///< of all threads of the process meanwhile
  double read_back_ms = 0.0;  ///< from the target into the Picture
  std::vector<std::string> passes;
  std::optional<PointProgress> points;  ///< where OpenGL did not draw them as primitives
  int samples = 1;                      ///< of multisampling, a pixel
};

/// Pictures of scene graphs without a window: `stillframe render`, tests, servers. Any one thread.
class OffscreenRenderer {
 public:
  [[nodiscard]] static std::expected<std::unique_ptr<OffscreenRenderer>, Status> create();
  ~OffscreenRenderer();
  OffscreenRenderer(const OffscreenRenderer&) = delete;
  OffscreenRenderer& operator=(const OffscreenRenderer&) = delete;

  /// Draws `root` seen from `view`. Compiled programs and uploaded arrays are kept while `root` stays the same.
  /// Refuses "BadSize" (not positive) and "TooLarge" (beyond the driver's largest texture, kMaxPixels or kMaxBytes).
  std::expected<Picture, Status> render(osg::Group& root, const CameraView& view, const RenderOptions& options);

  /// What the last picture shows at a pixel from its top left corner and near it (ViewPipeline::pick).
  [[nodiscard]] std::vector<PickHit> pick(int x_px, int y_px, int reach_px = ViewPipeline::kPickReachPx);

  [[nodiscard]] const FrameStatistics& lastFrame() const noexcept { return statistics_; }
  [[nodiscard]] OffscreenContext& context() noexcept { return *context_; }

  /// 32 bytes a pixel are needed without passes: 2 GiB.
  static constexpr long long kMaxPixels = 1LL << 26;
  /// Targets and the picture read back; four samples a pixel and all passes stay below it at kMaxPixels.
  static constexpr double kMaxBytes = 6.0 * (1LL << 30);

 private:
  explicit OffscreenRenderer(std::unique_ptr<OffscreenContext> context) : context_(std::move(context)) {}

  std::unique_ptr<OffscreenContext> context_;
  osg::ref_ptr<osg::Group> root_;
  std::unique_ptr<ViewPipeline> pipeline_;
  FrameStatistics statistics_;
};

}  // namespace stillframe::scenegraph
