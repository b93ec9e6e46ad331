#include <gmock/gmock.h>

#include <cmath>

#include "tests/nodes/images/image_builder.h"
#include "tests/nodes/scene_picture.h"
#include "tests/support/golden.h"
#include "tests/support/plain_viewer.h"

namespace stillframe::test {
namespace {

using scenegraph::ObjectType;
using testing::AllOf;
using testing::Ge;
using testing::Le;

constexpr std::uint32_t kColumns = 120;
constexpr std::uint32_t kRows = 90;
constexpr scenegraph::Color kBackground{.r = 0.12F, .g = 0.13F, .b = 0.15F, .a = 1.0F};

/// A wall 3 m away with a ball before it and a hole beside the ball, seen through a barrel lens; and its colours.
std::shared_ptr<scenegraph::Dataset> ballBeforeWall() {
  std::vector<std::uint16_t> depths;
  std::vector<std::uint8_t> rgb;
  for (std::uint32_t v = 0; v < kRows; ++v) {
    for (std::uint32_t u = 0; u < kColumns; ++u) {
      const double x = (u - 45.0) / 22.0;
      const double y = (v - 45.0) / 22.0;
      const double r2 = x * x + y * y;
      const bool is_hole = u >= 80 && u < 100 && v >= 35 && v < 55;
      const double depth = r2 < 1.0 ? 2.2 - 0.7 * std::sqrt(1.0 - r2) : 3.0;
      depths.push_back(is_hole ? std::uint16_t{0} : static_cast<std::uint16_t>(std::lround(1000.0 * depth)));
      const bool is_dark = ((u / 10) + (v / 10)) % 2 == 0;
      for (const int component : {r2 < 1.0 ? 230 : 60, is_dark ? 80 : 150, r2 < 1.0 ? 40 : 200}) {
        rgb.push_back(static_cast<std::uint8_t>(component));
      }
    }
  }
  scenegraph::CameraInfo info = cameraInfo("optical", kColumns, kRows, 90.0);
  info.distortion_model = "plumb_bob";
  info.distortion = {-0.25, 0.06, 0.001, -0.0005, 0.0};
  return DatasetBuilder()
      .topic("/tf", ObjectType::FrameTransforms)
      .transform(0, "map", "optical", {.rotation = {0.5, -0.5, 0.5, -0.5}, .translation = {0, 0, 1.2}})
      .topic("/camera/camera_info", ObjectType::CameraInfo)
      .at(1_s, info)
      .topic("/camera/color", ObjectType::Image)
      .at(1_s, makeImage<std::uint8_t>("optical", "rgb8", kColumns, rgb, 3))
      .topic("/camera/depth", ObjectType::Image)
      .at(1_s, depthImage16("optical", kColumns, depths))
      .build();
}

scenegraph::CameraView fromTheSide() {
  return {.eye_from_fixed = scenegraph::lookAt({-1.0, -2.0, 2.2}, {2.4, 0.1, 1.1}, {0, 0, 1})};
}

class DepthGolden : public ScenePictureTest {
 protected:
  void SetUp() override {
    ScenePictureTest::SetUp();
    open(ballBeforeWall(), "map");
  }
};

TEST_F(DepthGolden, ByDepth) {
  const auto& layer = add("/camera/depth", {{"point_size", "3"}, {"colormap", "turbo"}});
  const auto picture = draw(1_s, fromTheSide(), 320, 240);
  EXPECT_EQ(layer.status().code, "Ok") << layer.status().message;
  EXPECT_EQ(layer.counts()[0].second, kColumns * kRows - 400U);
  EXPECT_EQ(layer.counts()[1].second, 400U);
  EXPECT_LE(layer.counts()[4].second, 1U) << "1e-9 pixels";
  EXPECT_NEAR(layer.boundsInFixed().xMax(), 3.0, 1e-5);
  EXPECT_NEAR(layer.boundsInFixed().xMin(), 1.5, 1e-3);
  EXPECT_TRUE(matchesGolden(picture, "depth_image"));
  EXPECT_THAT(drawnPixels(picture), AllOf(Ge(38300), Le(39500)));
}

TEST_F(DepthGolden, ByTheRegisteredImage) {
  const auto& layer = add("/camera/depth", {{"point_size", "3"}, {"color_mode", "rgb"}});
  const auto picture = draw(1_s, fromTheSide(), 320, 240);
  EXPECT_EQ(layer.status().code, "Ok") << layer.status().message;
  EXPECT_TRUE(matchesGolden(picture, "depth_image_rgb"));
}

TEST_F(DepthGolden, IsTheSameInAPlainViewer) {
  auto& layer = add("/camera/depth", {{"point_size", "3"}});
  for (const char* mode : {"depth", "rgb"}) {
    ASSERT_TRUE(layer.applySettings({{"color_mode", mode}}));
    scene_->update(tf::TimePoint{1_s});
    const auto ours = scenegraph::toBytes(
        render(scene_->root(), fromTheSide(), {.width = 320, .height = 240, .background = kBackground}));
    for (const char* const extension : kExportExtensions) {
      const osg::ref_ptr<osg::Node> back = exportedAndRead(scene_->root(), extension);
      ASSERT_TRUE(back.valid());
      // Near and far of a stock viewer come from this: the bound must reach from the camera to the wall.
      const osg::BoundingSphere bound = back->getBound();
      EXPECT_TRUE(bound.contains(osg::Vec3(2.99F, 0.0F, 1.2F)));
      EXPECT_LT(bound.radius(), 8.0F);
      const auto plain = drawPlainly(*back, fromTheSide(), 0.1, 100.0, 320, 240, kBackground);
      // Two points at one depth may change places: the buffers of the two viewers round depth differently.
      EXPECT_LE(difference(ours, plain).beyond_one, 3U) << mode << extension;
    }
  }
}

}  // namespace
}  // namespace stillframe::test
