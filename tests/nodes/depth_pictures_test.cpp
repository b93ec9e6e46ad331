#include <gmock/gmock.h>

#include <cmath>
#include <osg/Geometry>

#include "tests/nodes/images/image_builder.h"
#include "tests/nodes/picture_colors.h"
#include "tests/nodes/scene_picture.h"
#include "tests/support/setting_texts.h"

namespace stillframe::test {
namespace {

using scenegraph::CameraInfo;
using scenegraph::Image;
using scenegraph::ObjectType;
using scenegraph::StatusLevel;
using testing::HasSubstr;

/// Three pixels in a row: rays x = -1, 0, 1 at z = 1, seen along z by fromOptical().
constexpr double kFocal = 1.0;

DatasetBuilder camera(const CameraInfo& info) {
  DatasetBuilder builder;
  builder.topic("/tf", ObjectType::FrameTransforms).transform(0, "map", "optical");
  builder.topic("/depth/camera_info", ObjectType::CameraInfo).at(1_s, info);
  return builder;
}

/// From the optical frame's origin along its z, its y pointing down in the picture: 10 pixels of 200 are 1 m.
scenegraph::CameraView fromOptical() {
  return {.eye_from_fixed = scenegraph::lookAt({0, 0, 0}, {0, 0, 1}, {0, -1, 0}),
          .is_orthographic = true,
          .vertical_extent_m = 20.0};
}

using DepthPicture = ScenePictureTest;

TEST_F(DepthPicture, TakesTheCameraThatCameWithTheImageAndTheFrameThatIsChosen) {
  Image image = depthImage16("", 3, {2000, 4000, 6000});  // a DepthImage of a host: no frame, its own intrinsics
  image.camera = std::make_shared<const CameraInfo>(cameraInfo("", 3, 1, kFocal));
  open(camera(cameraInfo("optical", 3, 1, 77.0)).topic("/depth/image_raw", ObjectType::Image).at(1_s, image).build(),
       "map");
  auto& layer = add("/depth/image_raw", kBig);
  EXPECT_EQ(drawnPixels(draw(1_s, fromOptical())), 0);
  EXPECT_EQ(layer.status().code, "UnknownSource");
  EXPECT_THAT(layer.status().message, HasSubstr("names no frame"));
  ASSERT_TRUE(layer.applySettings({{"frame", "/optical"}}));
  const auto picture = draw(1_s, fromOptical());
  EXPECT_EQ(layer.status().code, "Ok") << layer.status().message;
  EXPECT_EQ(drawnPixels(picture), 3 * 81);
  expectNear(pixel(picture, 160, 100), colorAt("viridis", 1.0));
  // A topic that is named goes before the camera of the image: its narrow lens puts all points in the middle.
  ASSERT_TRUE(layer.applySettings({{"info_topic", "/depth/camera_info"}}));
  EXPECT_LT(drawnPixels(draw(1_s, fromOptical())), 2 * 81);
}

TEST_F(DepthPicture, PutsEachPixelOnItsRayAndColoursItByDepth) {
  open(camera(cameraInfo("optical", 3, 1, kFocal))
           .topic("/depth/image_raw", ObjectType::Image)
           .at(1_s, depthImage16("optical", 3, {2000, 4000, 6000}))
           .build(),
       "map");
  const auto& layer = add("/depth/image_raw", kBig);
  const auto picture = draw(1_s, fromOptical());
  EXPECT_EQ(layer.status().code, "Ok") << layer.status().message;
  // x = -2, 0 and 6 m.
  expectNear(pixel(picture, 80, 100), colorAt("viridis", 0.0));
  expectNear(pixel(picture, 100, 100), colorAt("viridis", 0.5));
  expectNear(pixel(picture, 160, 100), colorAt("viridis", 1.0));
  EXPECT_EQ(drawnPixels(picture), 3 * 81);
  EXPECT_EQ(layer.counts(),
            (scenegraph::LayerCounts{{"points", 3}, {"holes", 0}, {"left_out", 0}, {"bytes", 6}, {"residual_npx", 0}}));
  const osg::BoundingBoxd box = layer.boundsInFixed();
  EXPECT_NEAR(box.xMin(), -2.0, 1e-6);
  EXPECT_NEAR(box.xMax(), 6.0, 1e-6);
  EXPECT_NEAR(box.zMin(), 2.0, 1e-6);
  EXPECT_NEAR(box.zMax(), 6.0, 1e-6);
}

TEST_F(DepthPicture, LeavesOutHolesAndWhatIsTooFar) {
  constexpr float kNoDepth = std::numeric_limits<float>::quiet_NaN();
  open(camera(cameraInfo("optical", 5, 1, kFocal))
           .topic("/depth/image_raw", ObjectType::Image)
           .at(1_s, makeImage<float>("optical", "32FC1", 5, {1.0F, kNoDepth, 2.0F, 0.0F, 4.0F}))
           .build(),
       "map");
  auto& layer = add("/depth/image_raw", with(kBig, {{"color_mode", "flat"}}));
  EXPECT_EQ(drawnPixels(draw(1_s, fromOptical())), 3 * 81);
  ASSERT_TRUE(layer.applySettings({{"max_depth_m", "3"}}));
  EXPECT_EQ(drawnPixels(draw(1_s, fromOptical())), 2 * 81);
  EXPECT_EQ(layer.counts(), (scenegraph::LayerCounts{
                                {"points", 2}, {"holes", 2}, {"left_out", 1}, {"bytes", 20}, {"residual_npx", 0}}));
  EXPECT_NEAR(layer.boundsInFixed().zMax(), 2.0, 1e-6);
}

TEST_F(DepthPicture, TakesItsColoursFromTheRegisteredImage) {
  Image elsewhere = makeImage<std::uint8_t>("other", "rgb8", 3, std::vector<std::uint8_t>(9, 77), 3);
  open(camera(cameraInfo("optical", 3, 1, kFocal))
           .topic("/a/other", ObjectType::Image)
           .at(1_s, elsewhere)
           .topic("/color", ObjectType::Image)
           .at(1_s, makeImage<std::uint8_t>("optical", "bgr8", 3, {20, 10, 200, 10, 200, 20, 200, 20, 10}, 3))
           .topic("/depth/image_raw", ObjectType::Image)
           .at(500_ms, depthImage16("optical", 3, {2000, 4000, 6000}))
           .at(1_s, depthImage16("optical", 3, {2000, 4000, 6000}))
           .build(),
       "map");
  const auto& layer = add("/depth/image_raw", with(kBig, {{"color_mode", "rgb"}}));
  const auto picture = draw(1_s, fromOptical());
  EXPECT_EQ(layer.status().code, "Ok") << layer.status().message;
  expectNear(pixel(picture, 80, 100), {200, 10, 20}, 1);
  expectNear(pixel(picture, 100, 100), {20, 200, 10}, 1);
  expectNear(pixel(picture, 160, 100), {10, 20, 200}, 1);
}

TEST_F(DepthPicture, FallsBackToDepthWithoutARegisteredImage) {
  open(camera(cameraInfo("optical", 3, 1, kFocal))
           .topic("/color", ObjectType::Image)
           .at(1_s, makeImage<std::uint8_t>("optical", "rgb8", 2, std::vector<std::uint8_t>(6, 9), 3))
           .topic("/depth/image_raw", ObjectType::Image)
           .at(1_s, depthImage16("optical", 3, {2000, 4000, 6000}))
           .build(),
       "map");
  const auto& layer = add("/depth/image_raw", with(kBig, {{"color_mode", "rgb"}}));
  expectNear(pixel(draw(1_s, fromOptical()), 100, 100), colorAt("viridis", 0.5));
  EXPECT_EQ(layer.status().level, StatusLevel::Info);
  EXPECT_EQ(layer.status().code, "NoColorImage");
}

TEST_F(DepthPicture, SaysWhyItHasNoCamera) {
  open(camera(cameraInfo("another", 3, 1, kFocal))
           .topic("/late/camera_info", ObjectType::CameraInfo)
           .at(3_s, cameraInfo("optical", 4, 4, kFocal))
           .topic("/depth/image_raw", ObjectType::Image)
           .at(1_s, depthImage16("optical", 3, {2000, 4000, 6000}))
           .build(),
       "map");
  auto& layer = add("/depth/image_raw", kBig);
  EXPECT_EQ(drawnPixels(draw(1_s, fromOptical())), 0);
  EXPECT_EQ(layer.status().level, StatusLevel::Warn);
  EXPECT_EQ(layer.status().code, "NoCameraInfo");
  EXPECT_THAT(layer.status().message, HasSubstr("'/late/camera_info' begins later"));
  EXPECT_EQ(drawnPixels(draw(3_s, fromOptical())), 0);
  EXPECT_EQ(layer.status().code, "CameraInfoMismatch");
  EXPECT_THAT(layer.status().message, HasSubstr("4 x 4"));
  EXPECT_THAT(layer.status().message, HasSubstr("3 x 1"));
  ASSERT_TRUE(layer.applySettings({{"info_topic", "/depth/camera_info"}}));
  EXPECT_EQ(drawnPixels(draw(1_s, fromOptical())), 3 * 81);
  EXPECT_EQ(layer.status().code, "Ok") << layer.status().message;
}

TEST_F(DepthPicture, PrefersTheCameraThatFitsThenTheOneNamedMostAlike) {
  DatasetBuilder builder;
  builder.topic("/tf", ObjectType::FrameTransforms).transform(0, "map", "optical");
  builder.topic("/cam/color/camera_info", ObjectType::CameraInfo).at(1_s, cameraInfo("optical", 3, 1, 0.5));
  builder.topic("/cam/depth/camera_info", ObjectType::CameraInfo).at(1_s, cameraInfo("optical", 3, 1, kFocal));
  builder.topic("/cam/depth/half/camera_info", ObjectType::CameraInfo).at(1_s, cameraInfo("optical", 1, 1, 0.25));
  builder.topic("/cam/depth/image_raw", ObjectType::Image).at(1_s, depthImage16("optical", 3, {2000, 0, 0}));
  open(builder.build(), "map");
  const auto& layer = add("/cam/depth/image_raw");
  (void)draw(1_s, fromOptical());
  EXPECT_NEAR(layer.boundsInFixed().xMin(), -2.0, 1e-6);
}

TEST_F(DepthPicture, ShowsNothingOfAColourImageAndSaysSo) {
  open(DatasetBuilder()
           .topic("/color", ObjectType::Image)
           .at(1_s, makeImage<std::uint8_t>("optical", "rgb8", 1, {1, 2, 3}, 3))
           .build(),
       "optical");
  const auto& layer = add("/color");
  EXPECT_EQ(drawnPixels(draw(1_s, fromOptical())), 0);
  EXPECT_EQ(layer.status().level, StatusLevel::Info);
  EXPECT_EQ(layer.status().code, "NotDepth");
  EXPECT_THAT(layer.status().message, HasSubstr("rgb8"));
}

TEST_F(DepthPicture, StraightensABentWall) {
  // A flat wall 4 m away through a barrel lens: its columns come out straight when rectified, bent when not.
  CameraInfo info = cameraInfo("optical", 64, 48, 40.0);
  info.distortion_model = "plumb_bob";
  info.distortion = {-0.2, 0.03, 0.001, -0.0005, 0.0};
  open(camera(info)
           .topic("/depth/image_raw", ObjectType::Image)
           .at(1_s, depthImage16("optical", 64, std::vector<std::uint16_t>(std::size_t{64} * 48, 4000)))
           .build(),
       "map");
  auto& layer = add("/depth/image_raw", {{"point_size", "2"}});
  const auto straight = draw(1_s, fromOptical(), 320, 240);
  EXPECT_EQ(layer.status().code, "Ok") << layer.status().message;
  const double wide = layer.boundsInFixed().xMax();
  ASSERT_TRUE(layer.applySettings({{"rectify", "false"}}));
  const auto bent = draw(1_s, fromOptical(), 320, 240);
  EXPECT_NEAR(layer.boundsInFixed().xMax(), 4.0 * 31.5 / 40.0, 1e-5);
  EXPECT_GT(wide, 4.0 * 31.5 / 40.0 * 1.1);
  EXPECT_NE(straight.rgb, bent.rgb);
}

TEST_F(DepthPicture, UploadsNoRaysForTheNextImageAndNothingForASetting) {
  open(camera(cameraInfo("optical", 3, 1, kFocal))
           .at(2_s, cameraInfo("optical", 3, 1, kFocal))
           .topic("/depth/image_raw", ObjectType::Image)
           .at(1_s, depthImage16("optical", 3, {2000, 4000, 6000}))
           .at(2_s, depthImage16("optical", 3, {2500, 4000, 6000}))
           .build(),
       "map");
  auto& layer = add("/depth/image_raw", kBig);
  (void)draw(1_s, fromOptical());
  const auto geometry = [&] {
    auto* node = scene_->frames().node("optical")->getChild(0)->asGroup();
    return node->getChild(0)->asDrawable()->asGeometry();
  };
  const osg::Array* rays = geometry()->getVertexArray();
  const osg::Array* depths = geometry()->getVertexAttribArray(6);
  ASSERT_TRUE(layer.applySettings({{"colormap", "plasma"}, {"range_mode", "manual"}, {"max_depth_m", "5"}}));
  (void)draw(1_s, fromOptical());
  EXPECT_EQ(geometry()->getVertexArray(), rays);
  EXPECT_EQ(geometry()->getVertexAttribArray(6), depths);
  EXPECT_EQ(depths->getModifiedCount(), 0U);
  (void)draw(2_s, fromOptical());
  EXPECT_EQ(geometry()->getVertexArray(), rays) << "another message with equal intrinsics";
  EXPECT_NE(geometry()->getVertexAttribArray(6), depths);
}

}  // namespace
}  // namespace stillframe::test
