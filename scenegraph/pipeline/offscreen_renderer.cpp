#include "scenegraph/pipeline/offscreen_renderer.h"

#include <GL/gl.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <semaphore>
#include <thread>
#include <utility>

#include "scenegraph/stopwatch.h"

namespace stillframe::scenegraph {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBusyPause(1);  // as in a window

double cpuMs() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

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
  output_.reset();
}

std::expected<void, Status> OffscreenRenderer::makeReady(osg::Group& root, const RenderOptions& options) {
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
  return {};
}

void OffscreenRenderer::noteFrame(std::chrono::steady_clock::time_point start, double cpu_start_ms) {
  glFinish();
  statistics_.frame_ms = millisecondsSince(start);
  statistics_.cpu_ms = cpuMs() - cpu_start_ms;
  statistics_.passes = pipeline_->passes();
  statistics_.points = pipeline_->pointProgress();
  statistics_.samples = pipeline_->samples();
  statistics_.blended_bands = pipeline_->blendedBands();
}

std::expected<Picture, Status> OffscreenRenderer::render(osg::Group& root, const CameraView& view,
                                                         const RenderOptions& options) {
  if (const auto ready = makeReady(root, options); !ready) {
    return std::unexpected(ready.error());
  }
  pipeline_->setView(view);
  const auto start = Clock::now();
  const double cpu_start_ms = cpuMs();
  if (const auto drawn = drawPicture(*pipeline_, options); !drawn) {
    return std::unexpected(drawn.error());
  }
  noteFrame(start, cpu_start_ms);
  const auto read_start = Clock::now();
  auto picture = readPicture(*pipeline_, options);
  statistics_.read_back_ms = millisecondsSince(read_start);
  return picture;
}

std::expected<void, Status> OffscreenRenderer::show(osg::Group& root, const CameraView& view,
                                                    const RenderOptions& options) {
  if (const auto ready = makeReady(root, options); !ready) {
    return std::unexpected(ready.error());
  }
  if (output_ == nullptr || output_->width() != options.width || output_->height() != options.height) {
    output_ = std::make_unique<gl::Output>(options.width, options.height);
  }
  takeOptions(*pipeline_, options);
  pipeline_->setView(view);
  const auto woken = std::make_shared<std::binary_semaphore>(0);
  pipeline_->setWake([woken] { woken->release(); });
  const auto start = Clock::now();
  const double cpu_start_ms = cpuMs();
  statistics_.step_ms = 0.0;
  std::expected<PictureStep, Status> done = PictureStep::More;
  while (done && *done != PictureStep::Whole) {
    if (*done == PictureStep::Waits) {
      woken->acquire();
    } else if (*done == PictureStep::Busy) {
      std::this_thread::sleep_for(kBusyPause);
    }
    const auto step_start = Clock::now();
    done = pipeline_->step(output_->id(), options.width, options.height, ViewPipeline::kStepMs);
    statistics_.step_ms = std::max(statistics_.step_ms, millisecondsSince(step_start));
  }
  if (!done) {
    pipeline_->setWake(nullptr);
    return std::unexpected(done.error());
  }
  const auto present_start = Clock::now();
  pipeline_->present(output_->id());
  pipeline_->setWake(nullptr);
  noteFrame(start, cpu_start_ms);
  statistics_.step_ms = std::max(statistics_.step_ms, millisecondsSince(present_start));
  statistics_.read_back_ms = 0.0;
  return {};
}

std::vector<PickHit> OffscreenRenderer::pick(int x_px, int y_px, int reach_px) {
  return pipeline_ != nullptr && context_->makeCurrent() ? pipeline_->pick(x_px, y_px, reach_px)
                                                         : std::vector<PickHit>{};
}

}  // namespace stillframe::scenegraph
