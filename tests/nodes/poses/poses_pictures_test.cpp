#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "nodes/points/colormap.h"
#include "tests/nodes/occupancy_grid/grid_builder.h"
#include "tests/nodes/poses/poses_picture.h"

namespace stillframe::test {
namespace {

using scenegraph::ObjectType;
using scenegraph::PosesInFrame;
using scenegraph::PosesKind;
using scenegraph::SettingTexts;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST_F(PosesPicture, DrawsATriadAtEachPose) {
  const auto poses = posesOf(PosesKind::Array, {turn(std::numbers::pi / 2, -4, -4), translate(3, 3, 0)});
  auto picture = drawPoses(poses, {{"length", "5"}});
  EXPECT_EQ(hue(pixel(picture, 60, 110)), 0) << "the first one's x points up";
  EXPECT_EQ(hue(pixel(picture, 30, 140)), 1) << "its y to the left";
  EXPECT_EQ(hue(pixel(picture, 160, 70)), 0);
  EXPECT_EQ(hue(pixel(picture, 130, 40)), 1);
  EXPECT_EQ(layer_->status(), scenegraph::Status{});
  EXPECT_EQ(layer_->counts(),
            (scenegraph::LayerCounts{{"poses", 2}, {"shapes", 2}, {"segments", 0}, {"trail", 0}, {"dropped", 0}}));
  const auto box = scene_->boundsInFixed();
  EXPECT_NEAR(box.zMax(), 5.0, 1e-6);
  EXPECT_NEAR(box.xMax(), 8.0, 1e-6);

  ASSERT_TRUE(layer_->applySettings({{"override_color", "true"}, {"arm_color", "#0000ff"}}));
  picture = draw(1_s, fromAbove());
  EXPECT_EQ(hue(pixel(picture, 60, 110)), 2);
  EXPECT_EQ(hue(pixel(picture, 30, 140)), 2);
  ASSERT_TRUE(layer_->applySettings({{"shape", "arrows"}, {"override_color", "false"}, {"opacity", "0.5"}}));
  picture = draw(1_s, fromAbove());
  EXPECT_EQ(hue(pixel(picture, 60, 110)), 0);
  EXPECT_EQ(pixel(picture, 30, 140), (Bytes3{0, 0, 0})) << "only x";
  EXPECT_NEAR(pixel(picture, 60, 110)[0], 172, 6) << "half of its light over black";
}

TEST_F(PosesPicture, SaysWhichPosesAreNotAsTheyShouldBe) {
  const auto picture = drawPoses(posesOf(PosesKind::Array, {{.rotation = {0.0, 0.0, 0.0, 0.0}},
                                                            {.rotation = {1e-300, 0.0, 0.0, 1e-300}},
                                                            {.rotation = {kNan, 0, 0, 0}},
                                                            {.translation = {kNan, 0, 0}}}),
                                 {{"length", "5"}, {"shape", "arrows"}});
  EXPECT_EQ(hue(pixel(picture, 130, 100)), 0) << "0 0 0 0 is drawn unturned";
  EXPECT_EQ(hue(pixel(picture, 100, 70)), 0) << "a quarter turn of norm 1e-300";
  EXPECT_EQ(count("shapes"), 2U);
  EXPECT_EQ(count("dropped"), 1U);
  EXPECT_EQ(layer_->status().code, "PosesNotFinite");
  for (const char* text : {"1 of 4 poses has a NaN or infinite place", "1 of 4 poses has the rotation 0 0 0 0",
                           "infinite rotation", "norm 1"}) {
    EXPECT_THAT(layer_->status().message, HasSubstr(text));
  }
  drawPoses(posesOf(PosesKind::Array, {}));
  EXPECT_EQ(layer_->status().code, "NoPoses");
  EXPECT_FALSE(scene_->boundsInFixed().valid());
  drawPoses(pointsOf(PosesKind::Path, {{1, 2, 3}, {1, 2, 3}}));
  EXPECT_EQ(layer_->status().code, "NothingDrawn");
  EXPECT_THAT(layer_->status().message, HasSubstr("2 poses at one place, which makes no line"));
}

TEST_F(PosesPicture, DrawsAPathOfAnyWidthColouredByTime) {
  const auto path =
      pointsOf(PosesKind::Path, {{-10, 0.013, 0}, {-5, 0.013, 0}, {kNan, 0, 0}, {0, 0.013, 0}, {10, 0.013, 0}});
  auto picture = drawPoses(path, {{"line_width", "4"}, {"color", "#ffffff"}});
  EXPECT_EQ(drawnPixels(picture), 4 * 150);
  EXPECT_EQ(count("segments"), 2U);
  EXPECT_EQ(count("shapes"), 0U);
  EXPECT_EQ(layer_->status().code, "PosesNotFinite");
  ASSERT_TRUE(layer_->applySettings({{"line_width", "0.8"}, {"line_unit", "m"}}));
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 8 * 150);
  ASSERT_TRUE(layer_->applySettings({{"color_field", "time"}, {"colormap", "viridis"}}));
  picture = draw(1_s, fromAbove());
  const nodes::Colormap& viridis = *nodes::findColormap("viridis");
  for (const auto& [x, t] : {std::pair{1, 0.0}, {101, 0.75}, {149, 0.87}, {198, 1.0}}) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(pixel(picture, x, 100)[c], viridis.at(t)[c] * 255, 5) << x;
    }
  }
  ASSERT_TRUE(layer_->applySettings({{"color_field", "x"}, {"range_mode", "manual"}, {"range_max", "20"}}));
  picture = draw(1_s, fromAbove());
  EXPECT_NEAR(pixel(picture, 198, 100)[1], viridis.at(0.5)[1] * 255, 4);
  ASSERT_TRUE(layer_->applySettings({{"line", "off"}}));
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
}

TEST_F(PosesPicture, LiesOnAMapWithoutFightingForDepth) {
  auto map = makeUniformGrid(40, 40, 0);
  map.origin.translation = {-20, -20, 0};
  open(DatasetBuilder()
           .topic("/tf", ObjectType::FrameTransforms)
           .transform(0, "map", "base")
           .topic("/map", ObjectType::OccupancyGrid)
           .at(1_s, map)
           .topic("/poses", ObjectType::PosesInFrame)
           .at(1_s, pointsOf(PosesKind::Path, {{-5, -3, 0}, {0, 4, 0}, {5, -3, 0}}))
           .build(),
       "map");
  add("/poses", {{"line_width", "6"}, {"color", "#ff0000"}});
  const scenegraph::CameraView view{.eye_from_fixed = scenegraph::lookAt({0, -16, 7}, {0, 0, 0}, {0, 0, 1})};
  const int alone = drawnPixels(draw(1_s, view));
  add("/map");
  const auto picture = draw(1_s, view);
  int red = 0;
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      red += pixel(picture, x, y) == Bytes3{255, 0, 0} ? 1 : 0;
    }
  }
  EXPECT_GE(alone, 800);
  EXPECT_EQ(red, alone);
}

TEST_F(PosesPicture, DrawsThePositionsCovarianceAboutTheAxesOfTheFrame) {
  // 2 m along x and 1 m along y, z unknown as a planar robot says; the pose itself is turned.
  auto pose = uncertainPose(turn(std::numbers::pi / 4), {4.0, 1.0, 1e12, 0, 0, 0});
  auto picture = drawPoses(pose, {{"shape", "none"}, {"covariance_color", "#ff00ff"}});
  EXPECT_NEAR(extent(picture).first, 40, 1);
  EXPECT_NEAR(extent(picture).second, 20, 1);
  EXPECT_NEAR(drawnPixels(picture), std::numbers::pi * 20 * 10, 25);
  EXPECT_EQ(layer_->status().code, "UnboundedCovariance");
  EXPECT_THAT(layer_->status().message, HasSubstr("along 1 axis"));
  ASSERT_TRUE(layer_->applySettings({{"sigma", "3"}}));
  EXPECT_NEAR(extent(draw(1_s, fromAbove())).first, 120, 1);
  ASSERT_TRUE(layer_->applySettings({{"covariance", "false"}}));
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
  EXPECT_EQ(layer_->status(), scenegraph::Status{});

  (*pose.covariance)[1] = (*pose.covariance)[6] = 2.0;  // wholly correlated: a line along (2, 1)
  picture = drawPoses(pose, {{"shape", "none"}, {"covariance_color", "#ff00ff"}, {"sigma", "4"}});
  EXPECT_NEAR(extent(picture).first, 160, 12);
  EXPECT_NEAR(extent(picture).second, 80, 8);
  EXPECT_NEAR(drawnPixels(picture), 500, 250);
}

TEST_F(PosesPicture, DrawsAConeThatTheDirectionVariesIn) {
  const SettingTexts settings{{"shape", "none"}, {"length", "8"}, {"cone_color", "#ffffff"}};
  // Yaw alone is known: a fan. Ahead is along y.
  auto pose = uncertainPose(turn(std::numbers::pi / 2, 0, -4), {0, 0, 0, 1e12, 1e12, 0.04});
  const auto picture = drawPoses(pose, settings);
  EXPECT_NEAR(extent(picture).first, 2 * 80 * std::tan(0.2), 2);
  EXPECT_NEAR(extent(picture).second, 80, 3);
  EXPECT_NEAR(drawnPixels(picture), 80 * 80 * std::tan(0.2), 40) << "a triangle";
  EXPECT_NE(pixel(picture, 100, 130), (Bytes3{0, 0, 0})) << "its point is at the pose";
  EXPECT_EQ(pixel(picture, 110, 135), (Bytes3{0, 0, 0}));
  ASSERT_TRUE(layer_->applySettings({{"orientation_cone", "false"}}));
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
}

TEST_F(PosesPicture, SaysWhatIsWrongWithACovariance) {
  for (const double bad : {-1.0, kNan}) {
    drawPoses(uncertainPose({}, {bad, 1.0, 1.0, 0, 0, 0}));
    EXPECT_EQ(layer_->status().code, "BadCovariance");
    EXPECT_THAT(layer_->status().message, HasSubstr("of the position has a "));
    EXPECT_EQ(count("shapes"), 1U) << "the pose itself is drawn";
  }
  drawPoses(uncertainPose({}, {1, 1, 1, 1, -1, 1}));
  EXPECT_THAT(layer_->status().message, HasSubstr("of the rotation has a negative"));
  drawPoses(uncertainPose({}, {1e-12, 1e12, 0, 1e300, 1e-300, 1e12}));
  EXPECT_EQ(layer_->status().code, "UnboundedCovariance");
  drawPoses(uncertainPose({}, {0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(layer_->status(), scenegraph::Status{});
}

TEST_F(PosesPicture, DrawsPolygonsClosedAndFilledAndPointsAsSpheres) {
  const auto arrow = pointsOf(PosesKind::Polygon, {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {0, 0, 0}, {-4, 4, 0}});
  auto picture = drawPoses(arrow, {{"line_width", "2"}, {"color", "#ffffff"}});
  EXPECT_NE(pixel(picture, 60, 100), (Bytes3{0, 0, 0})) << "the edge that closes it";
  EXPECT_EQ(pixel(picture, 100, 120), (Bytes3{0, 0, 0}));
  EXPECT_EQ(count("segments"), 5U);
  ASSERT_TRUE(layer_->applySettings({{"fill", "true"}, {"line", "off"}}));
  picture = draw(1_s, fromAbove());
  EXPECT_NEAR(drawnPixels(picture), 80 * 80 * 3 / 4, 60);
  EXPECT_EQ(pixel(picture, 100, 80), (Bytes3{0, 0, 0})) << "in the notch";
  EXPECT_NEAR(drawnPixels(draw(1_s, {.eye_from_fixed = scenegraph::lookAt({0, 0, -10}, {0, 0, 0}, {0, 1, 0}),
                                     .is_orthographic = true,
                                     .vertical_extent_m = 20.0})),
              80 * 80 * 3 / 4, 60)
      << "from below as well";
  drawPoses(pointsOf(PosesKind::Polygon, {{0, 0, 0}, {1, 0, 0}, {kNan, 1, 0}}), {{"fill", "true"}});
  EXPECT_THAT(layer_->status().message, HasSubstr("not filled"));

  picture = drawPoses(pointsOf(PosesKind::Point, {{2, 0, 0}}), {{"radius", "1.5"}});
  EXPECT_NEAR(drawnPixels(picture), std::numbers::pi * 15 * 15, 30);
  EXPECT_NE(pixel(picture, 120, 100), (Bytes3{0, 0, 0}));
}

TEST_F(PosesPicture, DrawsEverySoManyOfTooManyShapes) {
  std::vector<tf::RigidTransform> poses;
  for (int i = 0; i < 1000; ++i) {
    poses.push_back(translate(0.01 * i, 0, 0));
  }
  drawPoses(posesOf(PosesKind::Array, std::move(poses)), {{"max_shapes", "300"}});
  EXPECT_EQ(count("shapes"), 250U);
  EXPECT_EQ(layer_->status().code, "FewerShapes");
  EXPECT_THAT(layer_->status().message, HasSubstr("one pose in 4"));
}

TEST_F(PosesPicture, KeepsToWhatTheDriverTakesInABuffer) {
  std::vector<glm::dvec3> corners;
  for (int i = 0; i < 100; ++i) {
    corners.emplace_back(-9.0 + 0.18 * i, i % 2, 0.0);
  }
  open(datasetOf(pointsOf(PosesKind::Path, corners)), "map");
  layer_ = &add("/poses", {{"shape", "arrows"}, {"length", "1"}, {"line_width", "5"}});
  const int whole = drawnPixels(draw(1_s, fromAbove()));
  ASSERT_EQ(count("segments"), 99U);

  scene_->setBufferTexels(399);
  const int line_alone = drawnPixels(draw(1_s, fromAbove()));
  EXPECT_GT(line_alone, 1000);
  EXPECT_LT(line_alone, whole);
  EXPECT_EQ(layer_->status().code, "BufferTooLarge");
  EXPECT_THAT(layer_->status().message,
              HasSubstr("its 100 poses need a buffer of 400 texels; this OpenGL driver takes 399"));
  EXPECT_EQ(count("shapes"), 0U);
  EXPECT_EQ(count("segments"), 99U);

  scene_->setBufferTexels(99);
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
  EXPECT_EQ(count("segments"), 0U);
  EXPECT_FALSE(layer_->boundsInFixed().valid());

  scene_->setBufferTexels(400);
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), whole);
  EXPECT_EQ(layer_->status(), scenegraph::Status{});
}

TEST_F(PosesPicture, IsTheSameOnTheFarSideOfTheEarth) {
  const glm::dvec3 far{4'200'000.0, 470'000.0, 4'780'000.0};
  const auto scene = [](const glm::dvec3& at) {
    const auto moved = [&](double x, double y, double yaw) {
      tf::RigidTransform pose = turn(yaw, x, y);
      pose.translation += at;
      return pose;
    };
    auto odometry = uncertainPose(moved(2, 2, 1), {0.5, 0.3, 0.1, 0.1, 0.1, 0.1});
    return DatasetBuilder()
        .topic("/tf", ObjectType::FrameTransforms)
        .transform(0, "map", "base")
        .topic("/array", ObjectType::PosesInFrame)
        .at(1_s, posesOf(PosesKind::Array, {moved(-3, 0, 0), moved(-3, 3, 2)}))
        .topic("/path", ObjectType::PosesInFrame)
        .at(1_s, posesOf(PosesKind::Path, {moved(-6, -6, 0), moved(0, 2, 0), moved(6, -6, 0)}))
        .topic("/odometry", ObjectType::PosesInFrame)
        .at(1_s, odometry)
        .build();
  };
  std::vector<scenegraph::BytePicture> pictures;
  for (const glm::dvec3& at : {glm::dvec3(0.0), far}) {
    open(scene(at), "map");
    for (const char* topic : {"/array", "/path", "/odometry"}) {
      add(topic, {{"length", "2"}, {"line_width", "3"}});
    }
    pictures.push_back(draw(1_s, fromAbove(at.x, at.y, at.z + 10)));
  }
  EXPECT_GE(drawnPixels(pictures[0]), 900);
  int differing = 0;
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      differing += pixel(pictures[0], x, y) != pixel(pictures[1], x, y) ? 1 : 0;
    }
  }
  EXPECT_LE(differing, 4);
}

TEST_F(PosesPicture, NamesTheChildFrameOfAnOdometryWhenAsked) {
  PosesInFrame odometry;
  odometry.frame_id = "map";
  odometry.kind = PosesKind::Single;
  odometry.poses = {{.translation = {0, 0, 0}}};
  odometry.child_frame_id = "base_link";
  const auto plain = drawnPixels(drawPoses(odometry, {{"shape", "none"}}));
  EXPECT_EQ(plain, 0);
  const auto picture = drawPoses(odometry, {{"shape", "none"}, {"child_label", "true"}});
  EXPECT_GT(drawnPixels(picture), 100);
  const auto [width, height] = extent(picture);
  EXPECT_GT(width, 3 * height);
  odometry.child_frame_id = "";
  EXPECT_EQ(drawnPixels(drawPoses(odometry, {{"shape", "none"}, {"child_label", "true"}})), 0);
}

}  // namespace
}  // namespace stillframe::test
