#pragma once

#include <gtest/gtest.h>

#include <QPointF>
#include <memory>
#include <string>

#include "scenegraph/camera/picking.h"
#include "viewer/widget/scene_widget.h"

namespace stillframe::test {

/// A SceneWidget of 400 x 300 on the screen, in a window of its own, with makeRobotDataset() at 2 s. Smooth moves are
/// off; OpenGL's debug output must stay silent.
class ShownWidgetTest : public testing::Test {
 protected:
  static constexpr scenegraph::PictureSize kSize{400.0, 300.0};

  ShownWidgetTest();
  void TearDown() override;

  void goTo(std::int64_t time_ns);
  void key(int key, Qt::KeyboardModifiers modifiers = {});
  /// The cursor there, with no button down. Not by the X server's pointer, which is nobody's here.
  void hover(QPointF place);
  void click(QPointF place, Qt::KeyboardModifiers modifiers = {});
  /// Where a point of a frame is in the view; far outside for a frame that has no place.
  [[nodiscard]] QPointF pixelOf(const std::string& frame, const glm::dvec3& point_in_frame = glm::dvec3(0.0));

  std::shared_ptr<scenegraph::Dataset> dataset_;
  std::unique_ptr<scenegraph::Executor> executor_ = scenegraph::makeSynchronousExecutor();
  viewer::SceneWidget widget_;
};

}  // namespace stillframe::test
