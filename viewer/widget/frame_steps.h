#pragma once

#include <QSize>
#include <cstdint>

#include "scenegraph/camera/camera.h"

namespace stillframe::viewer {

/// Where the frame stands that a SceneWidget draws in steps, an event each, so that none keeps the window waiting. What
/// was shown before stays until the frame is whole. GUI thread.
struct FrameSteps {
  enum class At : std::uint8_t {
    Rest,      ///< no frame is being drawn
    UnderWay,  ///< the next step is on its way
    Waiting,   ///< it comes when others, or OpenGL, have done their part
    Ready,     ///< all is drawn but what puts it into the widget
  };
  [[nodiscard]] bool isUpToDate() const noexcept { return at == At::Rest && !is_wanted && !has_put_tick; }

  At at = At::Rest;
  bool is_wanted = true;        ///< something has changed since the last frame was begun
  bool is_first = true;         ///< of this context: shaders are made, and take long
  bool is_blank = true;         ///< the framebuffer is new: nothing is in it
  bool is_whole = false;        ///< somebody waits for the next frame
  bool has_put_tick = false;    ///< a tick was put off: the scene stands still meanwhile
  bool is_polling = false;      ///< OpenGL will be asked again
  bool is_moving = false;       ///< the camera is on its way in the frame that is drawn: its end is another picture
  QSize shown_px;               ///< of the whole frame that is shown
  scenegraph::CameraView view;  ///< that the last frame was begun from
};

}  // namespace stillframe::viewer
