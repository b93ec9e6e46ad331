#include "scenegraph/pipeline/point_stage.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include "generated/stillframe_render/shaders.h"
#include "scenegraph/geometry.h"
#include "scenegraph/pipeline/cpu_points.h"
#include "scenegraph/pipeline/full_screen.h"
#include "scenegraph/stopwatch.h"
#include "scenegraph/thread_priority.h"

namespace stillframe::scenegraph {
namespace {

namespace glsl = shaders::stillframe_render;
using Clock = std::chrono::steady_clock;

constexpr double kFirstGuess = 2e4;  // points a millisecond, of one slow core
constexpr double kNewest = 0.5;      // of the mean: soon right after a change, no slave of one slow frame

}  // namespace

PointStage::PointStage(unsigned threads) : PointStage(std::make_unique<CpuPoints>(threads)) {}

PointStage::PointStage(std::unique_ptr<PointDrawer> drawer)
    : drawer_(std::move(drawer)),
      points_per_ms_(kFirstGuess),
      triangle_(makeFullScreenTriangle(new osg::StateSet)),
      copy_(new PointPicture(*drawer_)),
      picture_(new osg::Group) {
  picture_->addChild(triangle_);
  picture_->addChild(copy_);
  picture_->setNodeMask(0);
  copy_->setNodeMask(0);
  osg::StateSet& state = *triangle_->getStateSet();
  state.setAttributeAndModes(makeProgram("points", glsl::k_full_screen_vert, glsl::k_points_frag));
  state.setTextureAttribute(0, &drawer_->colorTexture());
  state.setTextureAttribute(1, &drawer_->depthTexture());
  state.addUniform(new osg::Uniform{"u_color", 0});
  state.addUniform(new osg::Uniform{"u_depth", 1});
  constexpr int kBeforeAll = -1000;
  state.setRenderBinDetails(kBeforeAll, "RenderBin");
  copy_->getOrCreateStateSet()->setRenderBinDetails(kBeforeAll, "RenderBin");
}

void PointStage::setTargets(const std::optional<PointTargets>& targets) {
  wait();
  const bool is_copied = targets && !drawer_->needsContext();
  triangle_->setNodeMask(is_copied ? 0U : ~0U);
  copy_->setNodeMask(is_copied ? ~0U : 0U);
  copy_->setTargets(is_copied ? *targets : PointTargets{});
  const glm::vec4 background = is_copied ? targets->background : glm::vec4(0.0F);
  is_background_new_ = is_background_new_ || background != background_;
  background_ = background;
}

std::size_t PointStage::startAnew(const PointCollection& points, int width_px, int height_px) {
  in_view_ = {};
  for (const PointBatch& batch : points.batches) {
    in_view_.add(batch, width_px, height_px);
  }
  passes_ = 0;
  width_px_ = width_px;
  height_px_ = height_px;
  return drawer_->begin(points, width_px, height_px);
}

std::uint32_t PointStage::affordableEnd(double points, std::uint32_t most_passes) const {
  return std::min(std::max(in_view_.passesFor(points, passes_, most_passes), passes_ + 1), most_passes);
}

void PointStage::drawPasses(const PointLimits& limits, Clock::time_point start) {
  constexpr double kLeast = 0.25;  // of the budget, whatever else a frame needs
  constexpr double kShort = 0.3;   // of it: the rest is drawn in one go
  constexpr double kNothing = 0.05;
  // Where the rest of a frame takes all of its time, as on a busy machine, the picture still comes to an end.
  constexpr double kMostFrames = 64.0;
  const double budget_ms = std::max(limits.budget_ms - resolve_ms_, kLeast * limits.budget_ms);
  double least = passes_ == 0 ? 0.0 : static_cast<double>(in_view_.count()) / kMostFrames;
  const auto leftMs = [&] { return std::max(budget_ms - millisecondsSince(start), kNothing * budget_ms); };
  bool is_last = false;
  do {
    // Half of what time is left for, and another look at the clock: the cores may have other work than they had.
    const double left_ms = leftMs();
    is_last = left_ms <= kShort * budget_ms;
    const std::uint32_t end =
        affordableEnd(std::max((is_last ? 1.0 : 0.5) * left_ms * points_per_ms_, least), limits.passes);
    least = 0.0;
    const bool is_first = passes_ == 0;
    const auto before = Clock::now();
    drawer_->draw({passes_, end});
    const double drawn = in_view_.drawnBefore(end) - in_view_.drawnBefore(passes_);
    passes_ = end;
    noteRate(drawn / std::max(millisecondsSince(before), 1e-3), drawn, is_first);
  } while (!is_last && passes_ < limits.passes && leftMs() > kNothing * budget_ms);
}

void PointStage::noteRate(double points_per_ms, double points, bool is_first) {
  constexpr double kTelling = 2000.0;  // points: fewer tell of the call, not of a point
  // Later runs leave out groups that are hidden by then, which an empty picture hides none of.
  if (points >= kTelling && (is_first || points_per_ms < points_per_ms_)) {
    points_per_ms_ += kNewest * (points_per_ms - points_per_ms_);
  }
}

PointStage::~PointStage() { wait(); }

void PointStage::wait() const {
  if (started_.valid()) {
    started_.wait();
  }
}

PointProgress PointStage::draw(PointCollection points, int width_px, int height_px, const PointLimits& limits) {
  wait();
  return drawNow(std::move(points), width_px, height_px, limits);
}

void PointStage::start(PointCollection points, int width_px, int height_px, const PointLimits& limits,
                       std::function<void()> wake) {
  wait();
  is_under_way_ = true;
  if (aside_ == nullptr) {
    aside_ = makeThreadPoolExecutor(1);
  }
  const auto work = std::make_shared<std::packaged_task<PointProgress()>>(
      [this, points = std::move(points), width_px, height_px, limits, wake = std::move(wake)]() mutable {
        PointProgress progress = drawNow(std::move(points), width_px, height_px, limits);
        is_under_way_ = false;
        wake();
        return progress;
      });
  started_ = work->get_future();
  aside_->submit([work] { (*work)(); });
}

PointProgress PointStage::drawNow(PointCollection points, int width_px, int height_px, const PointLimits& limits) {
  const Precedence frame;
  picture_->setNodeMask(points.count > 0 ? ~0U : 0U);
  if (points.count == 0) {
    drawn_ = {};
    return {.by = drawer_->name()};
  }
  const auto start = Clock::now();
  // Compared while the arrays of both are alive: so the same address is the same array.
  const bool is_same_colors = std::ranges::equal(points.colors, drawn_.colors, &PointColors::isSame);
  PointProgress progress{.by = drawer_->name(), .points = points.count};
  if (points.batches != drawn_.batches || width_px_ != width_px || height_px_ != height_px || passes_ > limits.passes) {
    progress.upload_bytes = startAnew(points, width_px, height_px);
  }
  drawn_ = std::move(points);
  progress.in_view = in_view_.count();
  const bool is_drawing = passes_ < limits.passes;
  if (is_drawing) {
    drawPasses(limits, start);  // the time includes making room for the picture, some pixels a nanosecond
    progress.raster_ms = millisecondsSince(start);
  }
  const bool is_whole = passes_ == kPassesOfBothLaps || in_view_.count() == 0;
  progress.share = is_whole ? 1.0 : in_view_.drawnBefore(passes_) / static_cast<double>(in_view_.count());
  if (is_drawing || !is_same_colors || is_background_new_) {
    is_background_new_ = false;
    const auto drawn = Clock::now();
    progress.upload_bytes += drawer_->resolve(PointShading(drawn_.batches, drawn_.colors), background_);
    progress.resolve_ms = millisecondsSince(drawn);
    resolve_ms_ += kNewest * (progress.resolve_ms - resolve_ms_);
  }
  return progress;
}

std::span<const std::uint64_t> PointStage::keys(PointCollection points, int width_px, int height_px) {
  wait();
  if (points.batches != drawn_.batches || width_px_ != width_px || height_px_ != height_px) {
    (void)startAnew(points, width_px, height_px);
    drawer_->draw({});
    passes_ = kPassesOfBothLaps;
    drawn_ = std::move(points);
    drawn_.colors.clear();  // not in the textures yet: the next draw() sees others and resolves
  }
  return drawer_->keys();
}

}  // namespace stillframe::scenegraph
