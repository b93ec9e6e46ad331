// The frames of SceneWidget: drawn in steps, an event each.
#include <QScopedValueRollback>
#include <QTimer>
#include <QWindow>
#include <chrono>
#include <utility>

#include "scenegraph/pipeline/gl_target.h"
#include "scenegraph/pipeline/view_pipeline.h"
#include "viewer/pick/view_picker.h"
#include "viewer/widget/gl_format.h"
#include "viewer/widget/scene_widget.h"
#include "viewer/widget/size_px.h"

namespace stillframe::viewer {
namespace {

using At = FrameSteps::At;

// For the points of a frame, so that the camera follows the hand with any cloud.
constexpr double kSoftwareBudgetMs = 33.0;
constexpr double kHardwareBudgetMs = 12.0;
// Of which OpenGL, being software, is asked whether it has drawn a pass.
constexpr std::chrono::milliseconds kBusyPause(1);

QString problemText(const scenegraph::Status& status) {
  return SceneWidget::tr("The 3D view cannot be drawn.\n\n%1").arg(QString::fromStdString(status.message));
}

}  // namespace

void SceneWidget::update() {
  steps_.is_wanted = true;
  askForFrame();
}

/// Where OpenGL is software views take turns in drawing, and what paints the window only shows what is drawn.
void SceneWidget::askForFrame() {
  if (is_software_ && is_context_usable_ && !steps_.is_blank) {
    turn_.ask();
  } else {
    paintSoon();
  }
}

QImage SceneWidget::grabFramebuffer() {
  steps_.at = At::Rest;
  if (std::exchange(steps_.has_put_tick, false)) {
    applyTick();
  }
  const QScopedValueRollback whole(steps_.is_whole, true);
  return grabShown();
}

bool SceneWidget::paintGL() {
  if (!is_context_usable_) {
    return false;
  }
  if (steps_.at == At::Ready) {
    if (auto* const output = ownOutput()) {
      pipeline_->present(*output);
    } else {
      pipeline_->present(defaultFramebufferObject());
    }
    endFrame();
    return true;
  }
  if (steps_.at == At::Rest && (!is_software_ || steps_.is_whole)) {
    beginFrame();
    return true;
  }
  const bool is_filled = steps_.at == At::Rest && fillBlank();
  if (steps_.at == At::Rest && steps_.is_wanted) {
    turn_.ask();
  }
  return is_filled;
}

/// A new framebuffer shows what the last one did until a frame is whole. Returns whether it was new.
bool SceneWidget::fillBlank() {
  if (!std::exchange(steps_.is_blank, false)) {
    return false;
  }
  const QSize size_px = sizePxOf(*this);
  kept_.put(defaultFramebufferObject(), size_px.width(), size_px.height(),
            {background_.r, background_.g, background_.b, 1.0F});
  steps_.is_wanted = true;
  return true;
}

/// Of the size before a resize: the framebuffer goes with it.
void SceneWidget::keepPicture() {
  if (is_software_ && is_context_usable_ && !steps_.is_blank && kept_.isEmpty()) {
    makeCurrent();
    kept_.take(defaultFramebufferObject(), steps_.shown_px.width(), steps_.shown_px.height());
    doneCurrent();
  }
}

void SceneWidget::beginFrame() {
  if (pipeline_ == nullptr) {
    pipeline_ = std::make_unique<scenegraph::ViewPipeline>(
        scene_ == nullptr ? osg::ref_ptr<osg::Group>(new osg::Group) : osg::ref_ptr<osg::Group>(&scene_->root()));
    pipeline_->setPostChain(effects_.chain());
    pipeline_->setWake(wake_gate_.requester());
  }
  const QSize size_px = sizePxOf(*this);
  walk();
  const double begun_s = now();
  const scenegraph::CameraView view = camera_.view(begun_s);
  steps_.view = view;
  steps_.is_moving = camera_.isMoving(begun_s);
  if (scene_ != nullptr) {
    const QSizeF size = QSizeF(this->size()) * devicePixelRatioF();
    scene_->setView(view, {size.width(), size.height(), devicePixelRatioF()});
  }
  pipeline_->setView(view);
  pipeline_->setBackground(background_);
  pipeline_->setPointWay(point_way_);
  pipeline_->setPointLimits(
      {.budget_ms = point_budget_ms_.value_or(is_software_ ? kSoftwareBudgetMs : kHardwareBudgetMs)});
  steps_.is_wanted = false;
  // Drawn in steps, a new size would be empty as long.
  if (steps_.is_whole || (steps_.is_blank && !steps_.is_first && !is_software_)) {
    const auto drawn = pipeline_->render(defaultFramebufferObject(), size_px.width(), size_px.height());
    showProblem(drawn ? QString() : problemText(drawn.error()));
    endFrame();
    return;
  }
  (void)fillBlank();
  steps_.is_wanted = false;
  continueFrame();
  if (steps_.at == At::Ready && !is_software_) {
    pipeline_->present(defaultFramebufferObject());
    endFrame();
  }
}

/// A step of the frame that is under way, the context being current.
void SceneWidget::continueFrame() {
  const QSize size_px = sizePxOf(*this);
  const auto drawn =
      pipeline_->step(defaultFramebufferObject(), size_px.width(), size_px.height(), scenegraph::ViewPipeline::kStepMs);
  showProblem(drawn ? QString() : problemText(drawn.error()));
  if (!drawn) {
    steps_.at = At::Rest;
  } else if (*drawn == scenegraph::PictureStep::Whole) {
    steps_.at = At::Ready;
  } else if (*drawn == scenegraph::PictureStep::More) {
    steps_.at = At::UnderWay;
    turn_.ask();
  } else {
    steps_.at = At::Waiting;
    if (*drawn == scenegraph::PictureStep::Busy && !std::exchange(steps_.is_polling, true)) {
      QTimer::singleShot(kBusyPause, Qt::PreciseTimer, this, [this] {
        steps_.is_polling = false;
        turn_.ask();
      });
    }
  }
}

/// A turn of this view.
FrameTurn::Step SceneWidget::stepFrame() {
  using enum FrameTurn::Step;
  if (steps_.at == At::Ready || (steps_.at == At::Rest && !steps_.is_wanted)) {
    return Over;
  }
  const QWindow* const shown_in = window()->windowHandle();
  if (!is_context_usable_ || isLent() || !isVisible() || shown_in == nullptr || !shown_in->isExposed()) {
    if (std::exchange(steps_.at, At::Rest) != At::Rest) {
      steps_.is_wanted = true;  // what shows the view again asks for a frame
      requestTick();
    }
    if (isVisible() && !isLent()) {
      paintSoon();  // once it is exposed, which else may paint nothing
    }
    return Over;
  }
  if (steps_.at == At::Rest && picker_->holdsView()) {
    return Over;  // goOn() asks again
  }
  makeCurrent();
  if (steps_.at == At::Rest) {
    beginFrame();
  } else {
    continueFrame();
  }
  doneCurrent();
  if (steps_.at == At::Ready) {
    paintSoon();
  }
  return steps_.at == At::Waiting ? Waits : steps_.at == At::UnderWay ? GoesOn : Over;
}

void SceneWidget::endFrame() {
  steps_.at = At::Rest;
  steps_.is_blank = steps_.is_first = false;
  steps_.shown_px = sizePxOf(*this);
  kept_.release();
  ++frames_drawn_;
  showProgress();
  picker_->showFrame(steps_.view);
  if (keys_.isWalking() || steps_.is_moving || pointShare() < 1.0) {
    update();
  } else if (steps_.is_wanted) {
    askForFrame();  // while this one was drawn
  }
  if (std::exchange(steps_.has_put_tick, false)) {
    requestTick();
  }
  for (; logged_messages_ < debug_log_.messages().size(); ++logged_messages_) {
    qCWarning(glLog).noquote() << QString::fromStdString(debug_log_.messages()[logged_messages_]);
  }
}

}  // namespace stillframe::viewer
