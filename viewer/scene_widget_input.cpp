// Events of SceneWidget: gestures, keys, hover, being shown and resized.
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QWheelEvent>
#include <algorithm>

#include "scenegraph/camera/picking.h"
#include "viewer/scene_widget.h"

namespace stillframe::viewer {
namespace {

constexpr double kWheelNotch = 120.0;  // eighths of a degree, as QWheelEvent counts
constexpr double kHoverReach = 24.0;   // device-independent pixels, as the next
constexpr int kHoverOffset = 14;

}  // namespace

void SceneWidget::resizeEvent(QResizeEvent* event) {
  QOpenGLWidget::resizeEvent(event);
  message_->setGeometry(rect());
}

void SceneWidget::showEvent(QShowEvent* event) {
  QOpenGLWidget::showEvent(event);
  requestTick();
}

void SceneWidget::mousePressEvent(QMouseEvent* event) {
  gestures_.press(event->button(), event->modifiers(), event->position());
}

void SceneWidget::mouseMoveEvent(QMouseEvent* event) {
  if (!gestures_.isDragging()) {
    hover(event->position());
  } else if (gestures_.move(event->position(), size(), camera_)) {
    onCameraMoved();
  }
}

void SceneWidget::mouseReleaseEvent(QMouseEvent* event) { gestures_.release(event->button()); }

void SceneWidget::mouseDoubleClickEvent(QMouseEvent* event) {
  // Means nothing of its own: the second press drags like the first.
  mousePressEvent(event);
}

void SceneWidget::wheelEvent(QWheelEvent* event) {
  const double steps = event->angleDelta().y() / kWheelNotch;
  if (steps != 0.0) {
    OrbitGestures::wheel(steps, event->modifiers().testFlag(Qt::ControlModifier), event->position(), size(), camera_);
    onCameraMoved();
  }
  event->accept();
}

void SceneWidget::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Home) {
    home();
  } else if (event->key() == Qt::Key_F && event->modifiers() == Qt::NoModifier) {
    frameAll();
  } else {
    QOpenGLWidget::keyPressEvent(event);
  }
}

void SceneWidget::hover(QPointF position) {
  if (scene_ == nullptr || !is_context_usable_) {
    return;
  }
  const auto pick = scenegraph::pickFrame(scene_->frames(), camera_.view(),
                                          {static_cast<double>(width()), static_cast<double>(height())},
                                          {position.x(), position.y()}, kHoverReach);
  const QString frame = pick ? QString::fromStdString(pick->frame) : QString();
  if (frame.isEmpty()) {
    hover_label_->hide();
  } else {
    hover_label_->setText(frame);
    hover_label_->adjustSize();
    // Beside the cursor, on the side where there is room.
    const int right = qRound(position.x()) + kHoverOffset;
    const int left = qRound(position.x()) - kHoverOffset - hover_label_->width();
    const int below = qRound(position.y()) + kHoverOffset;
    hover_label_->move(right + hover_label_->width() <= width() ? right : std::max(0, left),
                       std::min(below, std::max(0, height() - hover_label_->height())));
    hover_label_->show();
  }
  if (frame != hovered_frame_) {
    hovered_frame_ = frame;
    Q_EMIT frameHovered(frame);
  }
}

void SceneWidget::leaveEvent(QEvent* event) {
  hover_label_->hide();
  hovered_frame_.clear();
  Q_EMIT frameHovered({});
  QOpenGLWidget::leaveEvent(event);
}

}  // namespace stillframe::viewer
