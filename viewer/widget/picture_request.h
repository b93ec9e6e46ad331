#pragma once

namespace stillframe::viewer {

/// What SceneWidget::takePicture() is asked for.
struct PictureRequest {
  int width_px = 1920;
  int height_px = 1080;
  bool is_transparent = false;   ///< alpha instead of the view's background
  bool has_legend = false;       ///< what colours of values mean, in its corner
  bool has_picks = false;        ///< what is picked and measured
  bool is_scene_linear = false;  ///< without what prepares light for a screen, for an .exr
};

}  // namespace stillframe::viewer
