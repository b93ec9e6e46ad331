#pragma once

#include <chrono>
#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <osg/Group>
#include <string>
#include <vector>

#include "scenegraph/pipeline/gl_output.h"
#include "scenegraph/pipeline/offscreen_context.h"
#include "scenegraph/pipeline/picture.h"
#include "scenegraph/pipeline/view_pipeline.h"
#include "scenegraph/status.h"

namespace stillframe::scenegraph {

/// What the last render() or show() did and took, in milliseconds of wall time with the GPU drained.
struct FrameStatistics {
  double frame_ms = 0.0;      ///< culling and drawing
  double step_ms = 0.0;       ///< of show(): the longest that it kept its thread busy at a time
  double cpu_ms = 0.0;        ///< of all threads of the process meanwhile
  double read_back_ms = 0.0;  ///< from the target into the Picture
  std::vector<std::string> passes;
  std::optional<PointProgress> points;  ///< where OpenGL did not draw them as primitives
  int samples = 1;                      ///< of multisampling, a pixel
  int blended_bands = 0;                ///< ViewPipeline::blendedBands()
};

/// Pictures of scene graphs without a window: `stillframe render`, tests, servers. Any one thread.
class OffscreenRenderer {
 public:
  [[nodiscard]] static std::expected<std::unique_ptr<OffscreenRenderer>, Status> create();
  ~OffscreenRenderer();
  OffscreenRenderer(const OffscreenRenderer&) = delete;
  OffscreenRenderer& operator=(const OffscreenRenderer&) = delete;

  /// Draws `root` seen from `view`. Compiled programs and uploaded arrays are kept while `root` stays the same.
  /// Refuses what checkPicture() does.
  std::expected<Picture, Status> render(osg::Group& root, const CameraView& view, const RenderOptions& options);
  /// Draws it as a window does, in steps, its points on a thread beside this one; shows it to nobody.
  std::expected<void, Status> show(osg::Group& root, const CameraView& view, const RenderOptions& options);

  /// What the last picture shows at a pixel from its top left corner and near it (ViewPipeline::pick).
  [[nodiscard]] std::vector<PickHit> pick(int x_px, int y_px, int reach_px = ViewPipeline::kPickReachPx);

  [[nodiscard]] const FrameStatistics& lastFrame() const noexcept { return statistics_; }
  [[nodiscard]] OffscreenContext& context() noexcept { return *context_; }

 private:
  explicit OffscreenRenderer(std::unique_ptr<OffscreenContext> context) : context_(std::move(context)) {}
  std::expected<void, Status> makeReady(osg::Group& root, const RenderOptions& options);
  void noteFrame(std::chrono::steady_clock::time_point start, double cpu_start_ms);

  std::unique_ptr<OffscreenContext> context_;
  osg::ref_ptr<osg::Group> root_;
  std::unique_ptr<ViewPipeline> pipeline_;
  std::unique_ptr<gl::Output> output_;  // of show()
  FrameStatistics statistics_;
};

}  // namespace stillframe::scenegraph
