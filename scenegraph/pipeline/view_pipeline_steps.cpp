// What a picture of ViewPipeline takes beside drawing it at once: steps, and what lies at a pixel.
#include <algorithm>
#include <chrono>
#include <utility>

#include "scenegraph/osg_matrix.h"
#include "scenegraph/pipeline/id_hits.h"
#include "scenegraph/pipeline/view_pipeline_impl.h"
#include "scenegraph/stopwatch.h"
#include "scenegraph/thread_priority.h"

namespace stillframe::scenegraph {
namespace {

constexpr double kMuch = 0.5;         // of the budget: points that take as much have a step of their own
constexpr double kShortWaitMs = 0.5;  // for OpenGL: another event would come no sooner

}  // namespace

std::expected<PictureStep, Status> ViewPipeline::step(std::uint32_t output_fbo, int width_px, int height_px,
                                                      double budget_ms) {
  Impl& impl = *impl_;
  if (width_px <= 0 || height_px <= 0) {
    impl.stepped.reset();
    impl.passes.clear();
    return PictureStep::Whole;
  }
  const Precedence frame(Precedence::Of::Window);
  const auto start = std::chrono::steady_clock::now();
  const auto remade = impl.makeReady(width_px, height_px, true);
  if (!remade) {
    impl.stepped.reset();
    return std::unexpected(remade.error());
  }
  Stages& stages = *impl.stages;
  const bool is_new = *remade || !impl.stepped;
  if (is_new) {
    impl.stepped.emplace();
    impl.projection_matrix = projection(impl.view, static_cast<double>(width_px) / height_px);
    stages.setView(toOsg(impl.view.eye_from_fixed), impl.projection_matrix, impl.background);
  }
  SteppedPicture& at = *impl.stepped;
  if (at.under_way != nullptr) {
    if (!impl.isStageDrawn(0.0)) {
      return PictureStep::Busy;
    }
    if (!impl.endStage()) {
      return PictureStep::More;
    }
  }
  impl.startAside(output_fbo);
  for (bool is_first = true; !impl.isDrawn(); is_first = false) {
    const double left_ms = budget_ms - millisecondsSince(start);
    const bool is_new_pass = impl.is_software && at.stage > 0 && at.stage >= impl.drawn_stages;  // its shaders are made
    if (!is_first && (left_ms <= 0.0 || is_new_pass)) {
      return PictureStep::More;
    }
    if (!at.has_points) {
      const PictureStep points = impl.stepPoints(budget_ms);
      if (points == PictureStep::Waits) {
        return points;
      }
      if (points == PictureStep::More || millisecondsSince(start) > kMuch * budget_ms) {
        return PictureStep::More;
      }
      continue;
    }
    impl.beginStage(left_ms);
    if (!at.is_begun) {
      at.is_begun = true;
      if (const auto checked = impl.checkTargets(); !checked && *remade) {
        impl.stepped.reset();
        return std::unexpected(checked.error());
      }
    }
    if (!impl.isStageDrawn(kShortWaitMs)) {
      return PictureStep::Busy;
    }
    if (!impl.endStage()) {
      return PictureStep::More;
    }
  }
  return PictureStep::Whole;
}

/// Where step() waits for nobody the output gets what is whole.
void ViewPipeline::Impl::startAside(std::uint32_t output_fbo) {
  if (!drawsAside()) {
    aside.reset();
  } else if (aside == nullptr || aside->width() != width_px || aside->height() != height_px) {
    aside = std::make_unique<gl::Output>(width_px, height_px);
  }
  startPicture(aside != nullptr ? aside->id() : output_fbo);
}

/// Asks OpenGL for the next stage, or a part of the scene.
void ViewPipeline::Impl::beginStage(double budget_ms) {
  stepped->under_way = std::make_unique<StageUnderWay>();
  stages->showOnly(stepped->stage, !stepped->is_begun);
  stages->steps().setBudget(budget_ms, is_software);
  if (aside != nullptr) {
    gl::bindFramebuffer(aside->id());  // OSG takes what is bound for the default
  }
  viewer->frame();
  if (drawsAside()) {
    stepped->under_way->fence.emplace();
  } else if (is_software) {
    gl::finish();
  }
}

bool ViewPipeline::Impl::isStageDrawn(double wait_ms) const {
  const auto& fence = stepped->under_way->fence;
  return !fence || fence->isReached(wait_ms);
}

/// OpenGL has drawn it. False: what is next goes into another step.
bool ViewPipeline::Impl::endStage() {
  SteppedPicture& at = *stepped;
  at.rest_ms += millisecondsSince(at.under_way->begun);
  at.under_way.reset();
  if (at.stage > 0 || stages->steps().isDone()) {
    drawn_stages = std::max(drawn_stages, ++at.stage);
  }
  if (at.stage == 0 && stages->steps().metNewProgram()) {
    return false;
  }
  if (const int next = at.sub_frame + 1; next < stages->subFrames() && at.stage > stages->lastOfSubFrame()) {
    at = SteppedPicture{};
    at.sub_frame = next;
  }
  return true;
}

/// Of the present sub-frame; Whole when that has all of its points: those of a picture that is not averaged become more
/// with the next.
PictureStep ViewPipeline::Impl::stepPoints(double budget_ms) {
  SteppedPicture& at = *stepped;
  if (at.awaits_points) {
    if (point_stage->isUnderWay()) {
      return PictureStep::Waits;
    }
    notePoints(point_stage->finish());
  } else {
    stages->startSubFrame(at.sub_frame);
    stages->beginSteps();
    auto work = findPoints(budget_ms);
    at.awaits_points = work && wake && !point_stage->drawer().needsContext();
    if (at.awaits_points) {
      point_stage->start(std::move(work->points), width_px, height_px, work->limits, wake);
      return PictureStep::Waits;
    }
    drawPoints(std::move(work));
  }
  at.awaits_points = false;
  at.has_points = stages->subFrames() == 1 || !point_progress || point_progress->share >= 1.0;
  return at.has_points ? PictureStep::Whole : PictureStep::More;
}

void ViewPipeline::present(std::unique_ptr<gl::Output>& output) {
  Impl& impl = *impl_;
  if (!impl.canPresent() || !impl.drawsAside() || output->width() != impl.width_px ||
      output->height() != impl.height_px) {
    present(output->id());
    return;
  }
  std::swap(output, impl.aside);
  const double rest_ms = impl.stepped->rest_ms;
  impl.stepped.reset();
  if (impl.point_progress && impl.isPaced()) {
    impl.noteRest(rest_ms);
  }
  output->bind();
  impl.namePasses();
}

void ViewPipeline::present(std::uint32_t output_fbo) {
  Impl& impl = *impl_;
  if (!impl.canPresent()) {
    return;
  }
  const Precedence frame(Precedence::Of::Window);
  const auto start = std::chrono::steady_clock::now();
  const double rest_ms = impl.stepped->rest_ms;
  impl.stepped.reset();
  if (impl.drawsAside()) {
    gl::copyColors(impl.aside->id(), output_fbo, impl.width_px, impl.height_px);
  } else {
    impl.stages->showOnly(impl.stages->count() - 1, false);
    impl.startPicture(output_fbo);
    impl.viewer->frame();
  }
  if (impl.is_software) {
    gl::finish();  // here, where the frame has precedence
  }
  if (impl.point_progress && impl.isPaced()) {
    impl.noteRest(rest_ms + millisecondsSince(start));
  }
  gl::bindFramebuffer(output_fbo);
  impl.namePasses();
}

osg::RenderInfo ViewPipeline::Impl::startPick() {
  takeOver();
  if (id_pass == nullptr) {
    id_pass = std::make_unique<IdPass>();
  }
  return {window->getState(), viewer};
}

IdPass::View ViewPipeline::Impl::idView(int x_px, int y_px, int reach_px) const {
  return {.eye_from_fixed = toOsg(view.eye_from_fixed),
          .clip_from_eye = toOsg(projection_matrix),
          .width_px = width_px,
          .height_px = height_px,
          .x_px = x_px,
          .y_px = height_px - 1 - y_px,
          .reach_px = reach_px};
}

bool ViewPipeline::warmPick() {
  Impl& impl = *impl_;
  if (!impl.stages || impl.passes.empty()) {
    return false;
  }
  osg::RenderInfo info = impl.startPick();
  const bool with_points = !impl.point_progress || impl.stage_way != PointWay::Cpu;
  return impl.id_pass->warm(*impl.root, impl.idView(impl.width_px / 2, impl.height_px / 2, kPickReachPx), info,
                            with_points);
}

std::vector<PickHit> ViewPipeline::pick(int x_px, int y_px, int reach_px) {
  Impl& impl = *impl_;
  const bool is_inside = x_px >= 0 && y_px >= 0 && x_px < impl.width_px && y_px < impl.height_px;
  if (!impl.stages || impl.passes.empty() || !is_inside) {
    return {};
  }
  const osg::Matrixd eye_from_fixed = toOsg(impl.view.eye_from_fixed);
  const osg::Matrixd clip_from_eye = toOsg(impl.projection_matrix);
  PointCollection points;
  std::optional<IdPass::CpuPoints> cpu_points;
  if (impl.point_progress && impl.stage_way == PointWay::Cpu) {
    points = collectPoints(*impl.root, eye_from_fixed, clip_from_eye, impl.height_px);
    cpu_points.emplace(impl.point_stage->keys(points, impl.width_px, impl.height_px), points);
  }
  osg::RenderInfo info = impl.startPick();
  const auto samples = impl.id_pass->draw(*impl.root, impl.idView(x_px, y_px, reach_px), info, cpu_points);
  const auto ordered = inOrderOfMeaning(samples.value_or(std::vector<IdSample>{}), impl.id_pass->drawables());
  return toHits(ordered, impl.id_pass->drawables(), impl.view, impl.width_px, impl.height_px, x_px, y_px);
}

}  // namespace stillframe::scenegraph
