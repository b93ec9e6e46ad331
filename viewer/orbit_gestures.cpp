#include "viewer/orbit_gestures.h"

namespace stillframe::viewer {

void OrbitGestures::press(Qt::MouseButton button, Qt::KeyboardModifiers modifiers, QPointF position) {
  if (isDragging()) {
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

bool OrbitGestures::move(QPointF position, QSizeF size, scenegraph::OrbitCamera& camera) {
  const QPointF moved = position - last_;
  if (!isDragging() || moved.isNull() || size.height() <= 0.0) {
    return false;
  }
  last_ = position;
  const auto before = camera.state();
  switch (drag_) {
    case Drag::Rotate:
      camera.rotate(moved.x(), moved.y(), size.height());
      break;
    case Drag::Pan:
      camera.pan(moved.x(), moved.y(), size.height());
      break;
    case Drag::Dolly:
      camera.dolly(moved.y(), size.height());
      break;
    case Drag::None:
      break;
  }
  return !(camera.state() == before);
}

void OrbitGestures::release(Qt::MouseButton button) {
  if (button == button_) {
    drag_ = Drag::None;
    button_ = Qt::NoButton;
  }
}

void OrbitGestures::wheel(double steps, bool at_cursor, QPointF position, QSizeF size,
                          scenegraph::OrbitCamera& camera) {
  const double before_m = camera.state().radius_m;
  camera.zoom(steps);
  if (!at_cursor || size.height() <= 0.0) {
    return;
  }
  // What lies under the cursor at the focal depth has moved away from the middle by the magnification: bring it back.
  const QPointF from_centre = position - QPointF(size.width() / 2.0, size.height() / 2.0);
  const QPointF moved = from_centre * (1.0 - before_m / camera.state().radius_m);
  camera.pan(moved.x(), moved.y(), size.height());
}

}  // namespace stillframe::viewer
