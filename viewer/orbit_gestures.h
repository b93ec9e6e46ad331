#pragma once

#include <QPointF>
#include <QSizeF>
#include <Qt>

#include "scenegraph/camera/orbit_camera.h"

namespace stillframe::viewer {

/// Mouse to orbit camera: left rotates, middle or Shift+left pans, right zooms along the axis, the wheel moves towards
/// the fixed target, with Ctrl towards the cursor. Positions and sizes in the same unit. No window.
class OrbitGestures {
 public:
  void press(Qt::MouseButton button, Qt::KeyboardModifiers modifiers, QPointF position);
  /// Returns whether the camera moved.
  bool move(QPointF position, QSizeF size, scenegraph::OrbitCamera& camera);
  void release(Qt::MouseButton button);
  [[nodiscard]] bool isDragging() const noexcept { return drag_ != Drag::None; }

  /// `steps`: notches of the wheel, forward is positive; fractions from touch pads.
  static void wheel(double steps, bool at_cursor, QPointF position, QSizeF size, scenegraph::OrbitCamera& camera);

 private:
  enum class Drag { None, Rotate, Pan, Dolly };
  Drag drag_ = Drag::None;
  Qt::MouseButton button_ = Qt::NoButton;
  QPointF last_;
};

}  // namespace stillframe::viewer
