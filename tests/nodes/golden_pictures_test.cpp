#include <gmock/gmock.h>

#include <filesystem>

#include "tests/nodes/robot_scene.h"
#include "tests/nodes/scene_picture.h"
#include "tests/support/golden.h"

namespace stillframe::test {
namespace {

using testing::AllOf;
using testing::Ge;
using testing::Le;

/// The robot of robot_scene.h from one side; beside each golden picture stand numbers that say what is in it.
class GoldenPicture : public ScenePictureTest {
 protected:
  void SetUp() override {
    ScenePictureTest::SetUp();
    open(robotAt({0, 0, 0}), "map");
  }
  scenegraph::BytePicture drawRobot() {
    return draw(1_s, {.eye_from_fixed = scenegraph::lookAt({3.5, -5.0, 4.0}, {0, 0, 0.3}, {0, 0, 1})}, 320, 240);
  }
  /// Pixels whose channel `c` is far above the other two.
  static int countHue(const scenegraph::BytePicture& picture, std::size_t c) {
    int count = 0;
    for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3) {
      const int own = picture.rgb[i + c];
      count += own > 60 + picture.rgb[i + (c + 1) % 3] && own > 60 + picture.rgb[i + (c + 2) % 3] ? 1 : 0;
    }
    return count;
  }
  static int countColor(const scenegraph::BytePicture& picture, const Bytes3& color) {
    int count = 0;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        count += pixel(picture, x, y) == color ? 1 : 0;
      }
    }
    return count;
  }
};

TEST_F(GoldenPicture, CloudByHeight) {
  add("/points", {{"color_field", "z"}, {"colormap", "turbo"}, {"point_size", "3"}});
  const auto picture = drawRobot();
  EXPECT_TRUE(matchesGolden(picture, "cloud_by_z"));
  EXPECT_THAT(drawnPixels(picture), AllOf(Ge(14000), Le(14600)));
  EXPECT_THAT(countHue(picture, 0), AllOf(Ge(3700), Le(4100)));
}

TEST_F(GoldenPicture, CloudByIntensity) {
  add("/points", {{"color_field", "intensity"}, {"colormap", "viridis"}, {"point_size", "3"}});
  const auto picture = drawRobot();
  EXPECT_TRUE(matchesGolden(picture, "cloud_by_intensity"));
  EXPECT_THAT(drawnPixels(picture), AllOf(Ge(14000), Le(14600)));
  EXPECT_EQ(countHue(picture, 0), 0) << "viridis has no red";
}

TEST_F(GoldenPicture, CloudInItsOwnColours) {
  add("/points", {{"color_field", "rgb"}, {"round_points", "true"}, {"point_size", "5"}});
  const auto picture = drawRobot();
  EXPECT_TRUE(matchesGolden(picture, "cloud_rgb"));
  EXPECT_THAT(drawnPixels(picture), AllOf(Ge(21600), Le(22300)));
  EXPECT_THAT(countHue(picture, 2), AllOf(Ge(3250), Le(3600)));
}

TEST_F(GoldenPicture, AxesAndParentLines) {
  add("tf", {{"axis_length", "0.8"}, {"hidden_frames", "utm"}});
  const auto picture = drawRobot();
  EXPECT_TRUE(matchesGolden(picture, "axes"));
  for (const std::size_t channel : {0U, 1U, 2U}) {
    EXPECT_THAT(countHue(picture, channel), AllOf(Ge(140), Le(285))) << channel;
  }
  EXPECT_THAT(countColor(picture, {255, 0, 255}), AllOf(Ge(70), Le(82)));
}

TEST_F(GoldenPicture, NamesOfFramesBesideOldOnes) {
  // Every frame here is 9 s old, and says so.
  add("tf", {{"axis_length", "0.8"}, {"hidden_frames", "utm"}, {"labels", "true"}, {"label_height", "12"}});
  const auto view =
      scenegraph::CameraView{.eye_from_fixed = scenegraph::lookAt({3.5, -5.0, 4.0}, {0, 0, 0.3}, {0, 0, 1})};
  const auto picture = draw(9_s, view, 320, 240);
  EXPECT_TRUE(matchesGolden(picture, "axes_names"));
  for (const std::size_t channel : {0U, 1U, 2U}) {
    EXPECT_LT(countHue(picture, channel), 40) << "dimmed";
  }
  EXPECT_EQ(drawnPixels(draw(9_s, view, 320, 240)), drawnPixels(picture)) << "drawn again, the same";
}

TEST_F(GoldenPicture, Grid) {
  add("grid");
  const auto picture = drawRobot();
  EXPECT_TRUE(matchesGolden(picture, "grid"));
  EXPECT_THAT(drawnPixels(picture), AllOf(Ge(3500), Le(3640)));
  EXPECT_EQ(countColor(picture, {92, 97, 105}), drawnPixels(picture));
}

TEST_F(GoldenPicture, PosesPathOdometryAndPolygon) {
  add("grid");
  add("/pose_array", {{"length", "0.7"}});
  add("/path", {{"color_field", "time"}, {"colormap", "turbo"}, {"line_width", "4"}});
  add("/odometry", {{"shape", "arrows"}, {"length", "1"}});
  add("/footprint", {{"fill", "true"}, {"color", "#ffffff"}});
  const auto picture = drawRobot();
  EXPECT_TRUE(matchesGolden(picture, "poses"));
  EXPECT_THAT(countHue(picture, 0), AllOf(Ge(500), Le(1500)));
  EXPECT_THAT(countHue(picture, 1), AllOf(Ge(200), Le(300)));
}

TEST_F(GoldenPicture, EverythingTogether) {
  add("grid");
  add("tf", {{"axis_length", "0.8"}, {"hidden_frames", "utm"}});
  add("/points", {{"color_field", "z"}, {"colormap", "turbo"}});
  const auto picture = drawRobot();
  EXPECT_TRUE(matchesGolden(picture, "everything"));
  EXPECT_THAT(drawnPixels(picture), AllOf(Ge(10500), Le(11000)));
  EXPECT_THAT(countColor(picture, {92, 97, 105}), AllOf(Ge(2700), Le(2900)));
}

TEST(Golden, TellsByHowMuchAPictureDiffersAndLeavesBoth) {
  const auto source = std::filesystem::path(STILLFRAME_SOURCE_DIR) / "tests" / "golden" / "grid.png";
  auto picture = scenegraph::readPng(source);
  ASSERT_TRUE(picture) << picture.error().message;
  EXPECT_TRUE(matchesGolden(*picture, "grid"));
  for (std::size_t i = 0; i < static_cast<std::size_t>(3 * 768); ++i) {
    picture->rgb[i] = 200;  // one pixel in a hundred
  }
  const auto left = std::filesystem::path(STILLFRAME_BINARY_DIR) / "golden";
  std::filesystem::remove(left / "grid_diff.png");
  const auto result = matchesGolden(*picture, "grid");
  ASSERT_FALSE(result);
  EXPECT_THAT(result.message(), testing::HasSubstr("1 % of the pixels"));
  EXPECT_EQ(scenegraph::readPng(left / "grid_actual.png"), *picture);
  EXPECT_TRUE(std::filesystem::exists(left / "grid_diff.png"));
  EXPECT_TRUE(matchesGolden(*picture, "grid", {.pixels = 0.01}));
  EXPECT_FALSE(matchesGolden(*picture, "no_such_picture"));
}

}  // namespace
}  // namespace stillframe::test
