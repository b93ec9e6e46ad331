#pragma once

namespace stillframe::viewer {

/// What SceneWidget::takePicture() is asked for.
struct PictureRequest {
  int width_px = 1920;
  int height_px = 1080;
  bool is_transparent = false;   ///< alpha instead of the view's background
  bool is_scene_linear = false;  ///< without what prepares light for a screen, for an .exr
};

}  // namespace stillframe::viewer
