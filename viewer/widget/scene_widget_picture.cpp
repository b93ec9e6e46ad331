// Pictures of what SceneWidget shows, for files, and what its layers take to draw: work that has the pipeline for
// itself.
#include <QTimer>
#include <algorithm>
#include <utility>

#include "nodes/legend/picture_overlay.h"
#include "scenegraph/pick/place_picks.h"
#include "scenegraph/pipeline/draw_times.h"
#include "scenegraph/pipeline/gl_context_info.h"
#include "viewer/pick/view_picks.h"
#include "viewer/widget/picture_job.h"
#include "viewer/widget/scene_widget.h"
#include "viewer/widget/size_px.h"

namespace stillframe::viewer {
namespace {

constexpr double kShareOfDrawing = 0.2;  // reading takes four times as long where OpenGL is software

scenegraph::Status notDrawn(const char* reason) { return {scenegraph::StatusLevel::Error, "NotDrawn", reason}; }

/// Points, lines and names as large against the picture as they are against the view.
scenegraph::PictureSize sizeOf(const PictureRequest& request, int view_height) {
  return {static_cast<double>(request.width_px), static_cast<double>(request.height_px),
          static_cast<double>(request.height_px) / std::max(1, view_height)};
}

}  // namespace

std::expected<void, scenegraph::Status> PictureJob::step() {
  if (reader_) {
    return reader_->step();
  }
  pipeline_.setView(view_);
  if (const auto drawn = scenegraph::drawPicture(pipeline_, options_); !drawn) {
    return std::unexpected(drawn.error());
  }
  reader_.emplace(pipeline_, options_);
  return {};
}

double PictureJob::share() const {
  return reader_ ? kShareOfDrawing + (1.0 - kShareOfDrawing) * reader_->share() : 0.0;
}

std::expected<void, scenegraph::Status> SceneWidget::beginPicture(const PictureRequest& request) {
  if (!is_context_usable_ || pipeline_ == nullptr) {
    return std::unexpected(notDrawn("the view has not been drawn yet"));
  }
  if (isLent()) {
    return std::unexpected(notDrawn("the view is busy with another picture"));
  }
  makeCurrent();
  const auto info = scenegraph::inspectCurrentContext();
  doneCurrent();
  scenegraph::RenderOptions options{.width = request.width_px,
                                    .height = request.height_px,
                                    .background = background_,
                                    .post = request.is_scene_linear ? effects_.linearChain() : effects_.chain()};
  if (request.is_transparent) {
    options.background.a = 0.0F;
  }
  if (!info) {
    return std::unexpected(info.error());
  }
  if (const auto checked = scenegraph::checkPicture(options, info->max_texture_size); !checked) {
    return std::unexpected(checked.error());
  }
  const scenegraph::CameraView view = shownView();
  if (scene_ != nullptr) {
    scene_->setView(view, sizeOf(request, height()));
  }
  picture_ = std::make_unique<PictureJob>(*pipeline_, request, std::move(options), view);
  return {};
}

std::expected<double, scenegraph::Status> SceneWidget::continuePicture() {
  if (picture_ == nullptr) {
    return std::unexpected(notDrawn("the view was closed or changed before its picture was drawn"));
  }
  makeCurrent();
  const auto stepped = picture_->step();
  doneCurrent();
  if (!stepped) {
    return std::unexpected(stepped.error());
  }
  return picture_->isDone() ? 1.0 : std::min(picture_->share(), 0.999);
}

scenegraph::Picture SceneWidget::endPicture() {
  if (picture_ == nullptr) {
    return {};
  }
  const auto job = std::exchange(picture_, nullptr);
  scenegraph::Picture picture = job->take();
  const PictureRequest& request = job->request();
  if (job->isDone() && scene_ != nullptr && !request.is_scene_linear) {
    const scenegraph::PictureSize size = sizeOf(request, height());
    nodes::PictureOverlay overlay(picture.rgba, picture.width, picture.height, size.pixel_ratio);
    if (request.has_picks) {
      overlay.addPicks(scenegraph::placePicks(*scene_, job->view(), size, picks().marks()));
    }
    if (request.has_legend) {
      overlay.addLegends(nodes::legendEntries(*scene_));
    }
  }
  takeBack();
  return picture;
}

/// The pipeline's targets are of another size now, and its chain may be.
void SceneWidget::takeBack() {
  steps_.at = FrameSteps::At::Rest;
  if (pipeline_ != nullptr) {
    pipeline_->setPostChain(effects_.chain());
  }
  requestTick();
  update();
}

std::expected<scenegraph::Picture, scenegraph::Status> SceneWidget::takePicture(const PictureRequest& request) {
  if (const auto begun = beginPicture(request); !begun) {
    return std::unexpected(begun.error());
  }
  for (double share = 0.0; share < 1.0;) {
    const auto done = continuePicture();
    if (!done) {
      endPicture();
      return std::unexpected(done.error());
    }
    share = *done;
  }
  return endPicture();
}

void SceneWidget::measureDrawTimes() {
  if (scene_ == nullptr || pipeline_ == nullptr || !is_context_usable_ || isLent()) {
    return;
  }
  pipeline_->setPointLimits({});
  draw_times_ = std::make_unique<scenegraph::DrawTimes>(*scene_);
  QTimer::singleShot(0, this, &SceneWidget::stepDrawTimes);
}

void SceneWidget::stepDrawTimes() {
  if (draw_times_ == nullptr) {
    return;
  }
  makeCurrent();
  const QSize size_px = sizePxOf(*this);
  draw_times_->step([&] { (void)pipeline_->renderLinear(size_px.width(), size_px.height()); });
  doneCurrent();
  if (draw_times_->isValid() && !draw_times_->isDone()) {
    sayProgress(tr("Taking draw times, %1 %").arg(qRound(100.0 * draw_times_->share())));
    QTimer::singleShot(0, this, &SceneWidget::stepDrawTimes);
    return;
  }
  const auto measured = std::exchange(draw_times_, nullptr);
  takeBack();
  if (measured->isValid()) {
    Q_EMIT drawTimesMeasured(measured->times());
  }
}

}  // namespace stillframe::viewer
