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

constexpr double kMuch = 0.5;  // of the budget: points that take as much have a step of their own

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
  impl.startPicture(output_fbo);
  SteppedPicture& at = *impl.stepped;
  for (bool is_first = true; at.stage + 1 < stages.count(); is_first = false) {
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
    const auto begun = std::chrono::steady_clock::now();
    stages.showOnly(at.stage, !at.is_begun);
    stages.steps().setBudget(left_ms, impl.is_software);
    impl.viewer->frame();
    if (impl.is_software) {
      gl::finish();
    }
    at.rest_ms += millisecondsSince(begun);
    if (!at.is_begun) {
      at.is_begun = true;
      if (const auto checked = impl.checkTargets(); !checked && *remade) {
        impl.stepped.reset();
        return std::unexpected(checked.error());
      }
    }
    if (at.stage > 0 || stages.steps().isDone()) {
      impl.drawn_stages = std::max(impl.drawn_stages, ++at.stage);
    }
    if (at.stage == 0 && stages.steps().metNewProgram()) {
      return PictureStep::More;
    }
    if (at.sub_frame + 1 < stages.subFrames() && at.stage > stages.lastOfSubFrame()) {
      at = {.sub_frame = at.sub_frame + 1};
    }
  }
  return PictureStep::Whole;
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

void ViewPipeline::present(std::uint32_t output_fbo) {
  Impl& impl = *impl_;
  if (!impl.stages || !impl.stepped || impl.stepped->stage + 1 < impl.stages->count()) {
    return;
  }
  const Precedence frame(Precedence::Of::Window);
  const auto start = std::chrono::steady_clock::now();
  const double rest_ms = impl.stepped->rest_ms;
  impl.stepped.reset();
  impl.stages->showOnly(impl.stages->count() - 1, false);
  impl.startPicture(output_fbo);
  impl.viewer->frame();
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
