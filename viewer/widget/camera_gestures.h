#pragma once

#include <QPointF>
#include <QSizeF>
#include <Qt>

#include "scenegraph/camera/view_camera.h"

namespace stillframe::viewer {

/// Mouse to camera: left rotates (a flying one looks about), middle or Shift+left pans, right zooms along the axis, the
/// wheel moves towards the fixed target, with Ctrl towards the cursor, with Shift it sets the pace of a flying camera.
/// Positions and sizes in the same unit. No window.
class CameraGestures {
 public:
  void press(Qt::MouseButton button, Qt::KeyboardModifiers modifiers, QPointF position);
  /// Returns whether the camera moved. A position that is not finite, as drivers send them, is left out.
  bool move(QPointF position, QSizeF size, scenegraph::ViewCamera& camera, double now_s);
  void release(Qt::MouseButton button);
  [[nodiscard]] bool isDragging() const noexcept { return drag_ != Drag::None; }

  /// `steps`: notches of the wheel, forward is positive; fractions from touch pads.
  static void wheel(double steps, Qt::KeyboardModifiers modifiers, QPointF position, QSizeF size,
                    scenegraph::ViewCamera& camera, double now_s);

 private:
  enum class Drag { None, Rotate, Pan, Dolly };
  Drag drag_ = Drag::None;
  Qt::MouseButton button_ = Qt::NoButton;
  QPointF last_;
};

}  // namespace stillframe::viewer
