#include "tests/nodes/robot_scene.h"
#include "tests/nodes/scene_picture.h"

namespace stillframe::test {
namespace {

/// On a screen with more pixels to the inch, points, lines and names are as large to the eye.
class PixelRatio : public ScenePictureTest {
 protected:
  void SetUp() override {
    ScenePictureTest::SetUp();
    open(robotAt({0, 0, 0}), "map");
  }
  /// Share of the picture that is drawn on.
  double drawn(int scale, double pixel_ratio, scenegraph::PointWay way) {
    scene_->update(tf::TimePoint{1_s});
    const int width = 200 * scale;
    const int height = 150 * scale;
    const scenegraph::CameraView view{.eye_from_fixed = scenegraph::lookAt({3.5, -5.0, 4.0}, {0, 0, 0.3}, {0, 0, 1})};
    scene_->setView(view, {static_cast<double>(width), static_cast<double>(height), pixel_ratio});
    const auto picture = renderer_->render(
        scene_->root(), view, {.width = width, .height = height, .background = {0, 0, 0, 1}, .points = way});
    EXPECT_TRUE(picture) << picture.error().message;
    return picture ? drawnPixels(scenegraph::toBytes(*picture)) / static_cast<double>(width * height) : 0.0;
  }
};

TEST_F(PixelRatio, KeepsPointsLinesAndNamesAsLargeAgainstThePicture) {
  for (const auto& [topic, settings] : std::vector<std::pair<std::string, scenegraph::SettingTexts>>{
           {"/points", {{"point_size", "2"}, {"color_field", "z"}}},
           {"/path", {{"line_width", "4"}}},
           {"tf",
            {{"labels", "true"}, {"axis_length", "0.0001"}, {"parent_lines", "false"}, {"hidden_frames", "utm"}}}}) {
    scenegraph::Layer& layer = add(topic, settings);
    for (const auto way : {scenegraph::PointWay::OpenGl, scenegraph::PointWay::Cpu}) {
      const double plain = drawn(1, 1.0, way);
      const double fine = drawn(2, 2.0, way);
      ASSERT_GT(plain, 0.001) << topic;
      if (topic == "tf") {  // the edges of letters are softer at one pixel than at two, and smaller ones find more room
        EXPECT_GT(fine / plain, 0.45);
      } else {
        EXPECT_NEAR(fine / plain, 1.0, 0.2) << topic;
        EXPECT_GT(fine, 1.6 * drawn(2, 1.0, way)) << topic << ": what it would be without";
      }
    }
    layer.setVisible(false);
  }
}

TEST_F(PixelRatio, IsNoPartOfAnExportedScene) {
  add("/points");
  (void)drawn(1, 1.0, scenegraph::PointWay::OpenGl);
  EXPECT_TRUE(scene_->root().getStateSet() == nullptr ||
              scene_->root().getStateSet()->getUniform("u_pixel_ratio") == nullptr);
}

}  // namespace
}  // namespace stillframe::test
