#include "scenegraph/pipeline/offscreen_renderer.h"

#include <GL/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <utility>

namespace stillframe::scenegraph {
namespace {

double millisecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Metres in front of the eye for a depth of [0, 1], whatever the projection.
class MetresFromDepth {
 public:
  explicit MetresFromDepth(const glm::dmat4& clip_from_eye)
      : zz_(clip_from_eye[2][2]), zw_(clip_from_eye[3][2]), wz_(clip_from_eye[2][3]), ww_(clip_from_eye[3][3]) {}
  [[nodiscard]] float operator()(float depth) const {
    if (!(depth > 0.0F)) {
      return std::numeric_limits<float>::infinity();
    }
    // depth = (zz z + zw) / (wz z + ww), solved for -z.
    const double d = static_cast<double>(depth);
    return static_cast<float>((d * ww_ - zw_) / (d * wz_ - zz_));
  }

 private:
  double zz_, zw_, wz_, ww_;
};

/// Top row first, in place.
void flipRows(std::vector<float>& values, std::size_t rows) {
  const auto stride = static_cast<std::ptrdiff_t>(values.size() / rows);
  for (auto low = values.begin(), high = values.end() - stride; low < high; low += stride, high -= stride) {
    std::swap_ranges(low, low + stride, high);
  }
}

Picture toPicture(LinearFrame frame, const RenderOptions& options, const glm::dmat4& clip_from_eye) {
  Picture picture{.width = options.width,
                  .height = options.height,
                  .rgba = std::move(frame.rgba),
                  .depth_m = std::move(frame.depth)};
  const auto rows = static_cast<std::size_t>(options.height);
  flipRows(picture.rgba, rows);
  flipRows(picture.depth_m, rows);
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4) {
    picture.rgba[i] = 1.0F;  // blending over an opaque background leaves a meaningless alpha
  }
  std::ranges::transform(picture.depth_m, picture.depth_m.begin(), MetresFromDepth{clip_from_eye});
  return picture;
}

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
}

std::expected<Picture, Status> OffscreenRenderer::render(osg::Group& root, const CameraView& view,
                                                         const RenderOptions& options) {
  const std::string size = std::to_string(options.width) + "x" + std::to_string(options.height);
  if (options.width <= 0 || options.height <= 0) {
    return std::unexpected(
        Status{StatusLevel::Error, "BadSize", "a picture of " + size + " pixels has no area; give at least 1x1"});
  }
  const int largest = context_->info().max_texture_size;
  if (options.width > largest || options.height > largest ||
      static_cast<long long>(options.width) * options.height > kMaxPixels) {
    return std::unexpected(Status{StatusLevel::Error, "TooLarge",
                                  "a picture of " + size + " pixels is too large: at most " + std::to_string(largest) +
                                      " on a side and " + std::to_string(kMaxPixels) + " in all"});
  }
  constexpr int kReadBackBytes = 20;  // colour and depth in floats
  const double bytes = (bytesPerPixel(options.post) + kReadBackBytes) * options.width * options.height;
  if (bytes > kMaxBytes) {
    return std::unexpected(Status{StatusLevel::Error, "TooLarge",
                                  "a picture of " + size + " pixels with these passes needs " +
                                      std::to_string(std::llround(bytes / (1LL << 20))) + " MiB, at most " +
                                      std::to_string(std::llround(kMaxBytes / (1LL << 20))) +
                                      " are taken; make it smaller or take fewer samples"});
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
  pipeline_->setBackground(options.background);
  pipeline_->setPointWay(options.points);
  pipeline_->setMostSorted(options.most_sorted);
  pipeline_->setPointLimits(options.point_limits);
  pipeline_->setPostChain(options.post);
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t cpu_start = std::clock();
  const auto drawn = pipeline_->renderLinear(options.width, options.height);
  if (!drawn) {
    return std::unexpected(drawn.error());
  }
  glFinish();
  statistics_.frame_ms = millisecondsSince(start);
  statistics_.cpu_ms = 1e3 * static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
  statistics_.passes = pipeline_->passes();
  statistics_.points = pipeline_->pointProgress();
  statistics_.samples = pipeline_->samples();
  const auto read_start = std::chrono::steady_clock::now();
  Picture picture = toPicture(pipeline_->readLinear(), options, pipeline_->projectionMatrix());
  statistics_.read_back_ms = millisecondsSince(read_start);
  return picture;
}

std::vector<PickHit> OffscreenRenderer::pick(int x_px, int y_px, int reach_px) {
  return pipeline_ != nullptr && context_->makeCurrent() ? pipeline_->pick(x_px, y_px, reach_px)
                                                         : std::vector<PickHit>{};
}

}  // namespace stillframe::scenegraph
