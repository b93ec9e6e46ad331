#include "scenegraph/pipeline/offscreen_renderer.h"

#include <GL/gl.h>

#include <chrono>
#include <ctime>
#include <utility>

#include "scenegraph/stopwatch.h"

namespace stillframe::scenegraph {

std::expected<std::unique_ptr<OffscreenRenderer>, Status> OffscreenRenderer::create() {
  auto context = OffscreenContext::create();
  if (!context) {
    return std::unexpected(context.error());
  }
  return std::unique_ptr<OffscreenRenderer>(new OffscreenRenderer(std::move(*context)));
}

OffscreenRenderer::~OffscreenRenderer() {
  context_->makeCurrent();
  pipeline_.reset();
}

std::expected<Picture, Status> OffscreenRenderer::render(osg::Group& root, const CameraView& view,
                                                         const RenderOptions& options) {
  if (const auto checked = checkPicture(options, context_->info().max_texture_size); !checked) {
    return std::unexpected(checked.error());
  }
  if (!context_->makeCurrent()) {
    return std::unexpected(Status{StatusLevel::Error, "NoOpenGl", "the context is in use on another thread"});
  }
  if (pipeline_ == nullptr || root_.get() != &root) {
    pipeline_.reset();
    root_ = &root;
    pipeline_ = std::make_unique<ViewPipeline>(root_);
  }
  pipeline_->setView(view);
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t cpu_start = std::clock();
  const auto drawn = drawPicture(*pipeline_, options);
  if (!drawn) {
    return std::unexpected(drawn.error());
  }
  glFinish();
  statistics_.frame_ms = millisecondsSince(start);
  statistics_.cpu_ms = 1e3 * static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
  statistics_.passes = pipeline_->passes();
  statistics_.points = pipeline_->pointProgress();
  statistics_.samples = pipeline_->samples();
  statistics_.blended_bands = pipeline_->blendedBands();
  const auto read_start = std::chrono::steady_clock::now();
  auto picture = readPicture(*pipeline_, options);
  statistics_.read_back_ms = millisecondsSince(read_start);
  return picture;
}

std::vector<PickHit> OffscreenRenderer::pick(int x_px, int y_px, int reach_px) {
  return pipeline_ != nullptr && context_->makeCurrent() ? pipeline_->pick(x_px, y_px, reach_px)
                                                         : std::vector<PickHit>{};
}

}  // namespace stillframe::scenegraph
