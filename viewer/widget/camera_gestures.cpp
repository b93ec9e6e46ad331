#include "viewer/widget/camera_gestures.h"

#include <cmath>

namespace stillframe::viewer {

void CameraGestures::press(Qt::MouseButton button, Qt::KeyboardModifiers modifiers, QPointF position) {
  if (isDragging() || !std::isfinite(position.x()) || !std::isfinite(position.y())) {
    return;  // a second button during a drag changes nothing
  }
  switch (button) {
    case Qt::LeftButton:
      drag_ = modifiers.testFlag(Qt::ShiftModifier) ? Drag::Pan : Drag::Rotate;
      break;
    case Qt::MiddleButton:
      drag_ = Drag::Pan;
      break;
    case Qt::RightButton:
      drag_ = Drag::Dolly;
      break;
    default:
      return;
  }
  button_ = button;
  last_ = position;
}

bool CameraGestures::move(QPointF position, QSizeF size, scenegraph::ViewCamera& camera, double now_s) {
  const QPointF moved = position - last_;
  if (!isDragging() || moved.isNull() || !std::isfinite(moved.x()) || !std::isfinite(moved.y()) ||
      size.height() <= 0.0) {
    return false;
  }
  last_ = position;
  const scenegraph::Sight before = camera.sight();
  scenegraph::CameraModel& model = camera.grasp(now_s);
  switch (drag_) {
    case Drag::Rotate:
      model.rotate(moved.x(), moved.y(), size.height());
      break;
    case Drag::Pan:
      model.pan(moved.x(), moved.y(), size.height());
      break;
    case Drag::Dolly:
      model.dolly(moved.y(), size.height());
      break;
    case Drag::None:
      break;
  }
  return !(camera.sight() == before);
}

void CameraGestures::release(Qt::MouseButton button) {
  if (button == button_) {
    drag_ = Drag::None;
    button_ = Qt::NoButton;
  }
}

void CameraGestures::wheel(double steps, Qt::KeyboardModifiers modifiers, QPointF position, QSizeF size,
                           scenegraph::ViewCamera& camera, double now_s) {
  if (modifiers.testFlag(Qt::ShiftModifier) && camera.rig().kind() == scenegraph::CameraKind::Fly) {
    camera.changePace(steps);
  } else if (modifiers.testFlag(Qt::ControlModifier) && size.height() > 0.0) {
    const QPointF from_centre = position - QPointF(size.width() / 2.0, size.height() / 2.0);
    camera.grasp(now_s).zoomAt(steps, {from_centre.x(), from_centre.y()}, size.height());
  } else {
    camera.grasp(now_s).zoom(steps);
  }
}

}  // namespace stillframe::viewer
