// The frames of SceneWidget: drawn in steps, an event each.
#include <QScopedValueRollback>
#include <QTimer>
#include <QWindow>
#include <utility>

#include "scenegraph/pipeline/gl_target.h"
#include "scenegraph/pipeline/view_pipeline.h"
#include "viewer/pick/view_picker.h"
#include "viewer/widget/gl_format.h"
#include "viewer/widget/scene_widget.h"

namespace stillframe::viewer {
namespace {

using At = FrameSteps::At;

// For the points of a frame, so that the camera follows the hand with any cloud.
constexpr double kSoftwareBudgetMs = 33.0;
constexpr double kHardwareBudgetMs = 12.0;

}  // namespace

void SceneWidget::update() {
  steps_.is_wanted = true;
  QOpenGLWidget::update();
}

QImage SceneWidget::grabFramebuffer() {
  steps_.at = At::Rest;
  if (std::exchange(steps_.has_put_tick, false)) {
    applyTick();
  }
  const QScopedValueRollback whole(steps_.is_whole, true);
  return QOpenGLWidget::grabFramebuffer();
}

void SceneWidget::paintGL() {
  if (!is_context_usable_ || steps_.at == At::UnderWay) {
    return;
  }
  if (steps_.at == At::Ready) {
    pipeline_->present(defaultFramebufferObject());
    endFrame();
  } else {
    beginFrame();
  }
}

void SceneWidget::beginFrame() {
  if (pipeline_ == nullptr) {
    pipeline_ = std::make_unique<scenegraph::ViewPipeline>(
        scene_ == nullptr ? osg::ref_ptr<osg::Group>(new osg::Group) : osg::ref_ptr<osg::Group>(&scene_->root()));
    pipeline_->setPostChain(effects_.chain());
  }
  const QSizeF size_px = QSizeF(size()) * devicePixelRatioF();
  walk();
  const scenegraph::CameraView view = shownView();
  if (scene_ != nullptr) {
    scene_->setView(view, {size_px.width(), size_px.height(), devicePixelRatioF()});
  }
  pipeline_->setView(view);
  pipeline_->setBackground(background_);
  pipeline_->setPointWay(point_way_);
  pipeline_->setPointLimits(
      {.budget_ms = point_budget_ms_.value_or(is_software_ ? kSoftwareBudgetMs : kHardwareBudgetMs)});
  steps_.is_wanted = false;
  // A new size has no picture that could stay. The first of a context has none to lose, and takes the longest.
  if (steps_.is_whole || (steps_.is_blank && !steps_.is_first)) {
    const auto drawn = pipeline_->render(defaultFramebufferObject(), qRound(size_px.width()), qRound(size_px.height()));
    showProblem(drawn ? QString() : problemText(drawn.error()));
    endFrame();
    return;
  }
  if (std::exchange(steps_.is_blank, false)) {
    scenegraph::gl::clearColor(defaultFramebufferObject(), {background_.r, background_.g, background_.b, 1.0F});
  }
  steps_.at = At::UnderWay;
  continueFrame();
  if (steps_.at == At::Ready) {
    pipeline_->present(defaultFramebufferObject());
    endFrame();
  }
}

/// A step of the frame that is under way, the context being current.
void SceneWidget::continueFrame() {
  const QSizeF size_px = QSizeF(size()) * devicePixelRatioF();
  const auto drawn = pipeline_->step(defaultFramebufferObject(), qRound(size_px.width()), qRound(size_px.height()),
                                     FrameSteps::kBudgetMs);
  showProblem(drawn ? QString() : problemText(drawn.error()));
  if (!drawn) {
    steps_.at = At::Rest;
  } else if (*drawn) {
    steps_.at = At::Ready;
  } else {
    QTimer::singleShot(0, this, &SceneWidget::stepFrame);
  }
}

void SceneWidget::stepFrame() {
  if (steps_.at != At::UnderWay) {
    return;
  }
  const QWindow* const shown_in = window()->windowHandle();
  if (pipeline_ == nullptr || !is_context_usable_ || isLent() || !isVisible() || shown_in == nullptr ||
      !shown_in->isExposed()) {
    steps_.at = At::Rest;  // what shows the view again asks for a frame
    requestTick();
    return;
  }
  makeCurrent();
  continueFrame();
  doneCurrent();
  if (steps_.at == At::Ready) {
    QOpenGLWidget::update();
  }
}

void SceneWidget::endFrame() {
  steps_.at = At::Rest;
  steps_.is_blank = steps_.is_first = false;
  ++frames_drawn_;
  showProgress();
  picker_->place();
  if (keys_.isWalking() || camera_.isMoving(now()) || pointShare() < 1.0) {
    update();
  } else if (steps_.is_wanted) {
    QOpenGLWidget::update();  // asked for while this one was drawn
  }
  if (std::exchange(steps_.has_put_tick, false)) {
    requestTick();
  }
  for (; logged_messages_ < debug_log_.messages().size(); ++logged_messages_) {
    qCWarning(glLog).noquote() << QString::fromStdString(debug_log_.messages()[logged_messages_]);
  }
}

QString SceneWidget::problemText(const scenegraph::Status& status) const {
  return tr("The 3D view cannot be drawn.\n\n%1").arg(QString::fromStdString(status.message));
}

}  // namespace stillframe::viewer
