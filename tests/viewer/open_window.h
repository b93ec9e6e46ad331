#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "viewer/widget/scene_widget.h"
#include "viewer/window/inspector_window.h"

namespace stillframe::test {

/// An inspector on the screen, over makeRobotDataset(). OpenGL's debug output must stay silent.
class OpenWindowTest : public testing::Test {
 protected:
  void TearDown() override;

  /// Shown, while the recording is still being loaded.
  void show(viewer::InspectorOptions options);
  /// Shown, loaded and drawn.
  void open(viewer::InspectorOptions options = {.files = {"robot.mcap"}});
  void complete();
  /// With the keyboard's focus.
  void activate();
  [[nodiscard]] viewer::SceneWidget& view(std::size_t index = 0) { return window_->views().at(index)->view(); }

  std::unique_ptr<viewer::InspectorWindow> window_;
};

}  // namespace stillframe::test
