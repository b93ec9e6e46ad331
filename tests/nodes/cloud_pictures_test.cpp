#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <limits>
#include <osg/Geometry>

#include "tests/nodes/picture_colors.h"
#include "tests/nodes/scene_picture.h"
#include "tests/support/setting_texts.h"

namespace stillframe::test {
namespace {

using scenegraph::FieldType;
using scenegraph::ObjectType;
using scenegraph::PointCloud;
using testing::HasSubstr;

/// Points at x = -8, 0, 8 with z and intensity as given.
PointCloud threePoints(std::array<double, 3> z, std::array<double, 3> intensity) {
  CloudBuilder builder("lidar");
  builder.xyz().field("intensity", FieldType::Float32);
  for (std::size_t i = 0; i < 3; ++i) {
    builder.point({-8.0 + 8.0 * static_cast<double>(i), 0.0, z[i], intensity[i]});
  }
  return builder.build();
}

std::shared_ptr<scenegraph::Dataset> datasetOf(PointCloud cloud, const tf::RigidTransform& map_from_lidar = {}) {
  return DatasetBuilder()
      .topic("/tf", ObjectType::FrameTransforms)
      .transform(0, "map", "lidar", map_from_lidar)
      .topic("/points", ObjectType::PointCloud)
      .at(1_s, std::move(cloud))
      .build();
}

class CloudPicture : public ScenePictureTest {
 protected:
  /// Colours of the three points.
  std::array<Bytes3, 3> drawThree(std::int64_t time_ns = 1_s) {
    const auto picture = draw(time_ns, fromAbove());
    return {pixel(picture, 20, 100), pixel(picture, 100, 100), pixel(picture, 180, 100)};
  }
};

TEST_F(CloudPicture, ColoursByIntensityOverItsRangeByDefault) {
  open(datasetOf(threePoints({0, 0, 0}, {10, 20, 30})), "map");
  const auto& layer = add("/points", kBig);
  const auto colors = drawThree();
  expectNear(colors[0], colorAt("viridis", 0.0));
  expectNear(colors[1], colorAt("viridis", 0.5));
  expectNear(colors[2], colorAt("viridis", 1.0));
  EXPECT_EQ(layer.status(), scenegraph::Status{});
  EXPECT_EQ(layer.counts(), (scenegraph::LayerCounts{{"points", 3}, {"dropped", 0}, {"bytes", 48}}));
}

TEST_F(CloudPicture, TheEarlierOfTwoLayersAtOnePlaceIsSeenWhicheverWasHiddenBefore) {
  open(datasetOf(threePoints({0, 0, 0}, {1, 2, 3})), "map");
  auto& first = add("/points", with(kBig, {{"color_field", "flat"}, {"flat_color", "#ff0000"}}));
  auto& second = add("/points#2", with(kBig, {{"color_field", "flat"}, {"flat_color", "#00ff00"}}));
  const Bytes3 red{255, 0, 0};
  const Bytes3 green{0, 255, 0};
  EXPECT_EQ(drawThree()[1], red);
  for (auto* const hidden : {&first, &second}) {
    hidden->setVisible(false);
    EXPECT_EQ(drawThree()[1], hidden == &first ? green : red);
    hidden->setVisible(true);
    EXPECT_EQ(drawThree()[1], red);
  }
  scene_->arrangeLayers(std::vector<std::string>{"/points#2", "/points"});
  EXPECT_EQ(drawThree()[1], green);
}

TEST_F(CloudPicture, SizesPointsInPixelsAndDrawsDiscsRound) {
  open(datasetOf(CloudBuilder("lidar").xyz().point({0, 0, 0}).build()), "map");
  auto& layer = add("/points", {{"point_size", "20"}, {"color_field", "flat"}});
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 400);
  ASSERT_TRUE(layer.applySettings({{"round_points", "true"}}));
  EXPECT_NEAR(drawnPixels(draw(1_s, fromAbove())), 314, 12);
  ASSERT_TRUE(layer.applySettings({{"round_points", "false"}, {"size_unit", "m"}, {"point_size", "3"}}));
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 900) << "3 m at 10 pixels per metre";
}

TEST_F(CloudPicture, ColoursAxesInTheFixedFrameAfterTheLiveTransform) {
  // The sensor lies on its side: its +y is the map's +z; the camera looks along it.
  const double half = std::sqrt(0.5);
  const tf::RigidTransform map_from_lidar{.rotation = {half, half, 0, 0}, .translation = {0, 0, 100}};
  CloudBuilder builder("lidar");
  builder.xyz();
  builder.point({-8, 0, 0}).point({0, 5, 0}).point({8, 10, 0});
  open(datasetOf(builder.build(), map_from_lidar), "map");
  add("/points", with(kBig, {{"color_field", "z"}, {"colormap", "viridis"}}));
  scene_->update(tf::TimePoint{1_s});
  const auto bounds = scene_->boundsInFixed();
  EXPECT_NEAR(bounds.zMin(), 100, 1e-9);
  EXPECT_NEAR(bounds.zMax(), 110, 1e-9);
  const auto picture = draw(1_s, fromAbove(0, 0, 200));
  expectNear(pixel(picture, 20, 100), colorAt("viridis", 0.0));
  expectNear(pixel(picture, 100, 100), colorAt("viridis", 0.5));
  expectNear(pixel(picture, 180, 100), colorAt("viridis", 1.0));
}

TEST_F(CloudPicture, LeavesStraysOutOfTheBoxOfItsBulk) {
  const tf::RigidTransform map_from_lidar{.rotation = {1, 0, 0, 0}, .translation = {1000, 0, 0}};
  CloudBuilder compact("lidar");
  compact.xyz();
  for (int i = 0; i <= 100; ++i) {
    compact.point({i * 0.1, i * 0.2, 0});
  }
  open(datasetOf(compact.build(), map_from_lidar), "map");
  add("/points", kBig);
  scene_->update(tf::TimePoint{1_s});
  EXPECT_NEAR(scene_->bulkInFixed().low.x, 1000, 1e-6) << "no strays: the whole box";
  EXPECT_NEAR(scene_->bulkInFixed().high.x, 1010, 1e-6);
  EXPECT_NEAR(scene_->bulkInFixed().high.y, 20, 1e-6);

  compact.point({1e6, -1e6, 5});
  open(datasetOf(compact.build(), map_from_lidar), "map");
  add("/points", kBig);
  scene_->update(tf::TimePoint{1_s});
  EXPECT_NEAR(scene_->boundsInFixed().xMax(), 1'001'000, 1) << "the box of all is that of all";
  EXPECT_NEAR(scene_->bulkInFixed().low.x, 1000, 1e-6);
  EXPECT_LT(scene_->bulkInFixed().high.x, 1016);
  EXPECT_GT(scene_->bulkInFixed().low.y, -11);
  EXPECT_NEAR(scene_->bulkInFixed().high.y, 20, 1);
}

TEST_F(CloudPicture, DrawsPointColoursByDefaultWhenThereAreAny) {
  CloudBuilder builder("lidar");
  builder.xyz().field("rgb", FieldType::Float32).field("intensity", FieldType::Float32);
  const auto word = [](std::uint32_t bits) { return static_cast<double>(std::bit_cast<float>(bits)); };
  builder.point({-8, 0, 0, word(0x00c80a14), 1})
      .point({0, 0, 0, word(0x000ac814), 2})
      .point({8, 0, 0, word(0x000a14c8), 3});
  open(datasetOf(builder.build()), "map");
  const auto& layer = add("/points", kBig);
  const auto colors = drawThree();
  expectNear(colors[0], {200, 10, 20}, 1);
  expectNear(colors[1], {10, 200, 20}, 1);
  expectNear(colors[2], {10, 20, 200}, 1);
  EXPECT_THAT(layer.settingSpecs().front().choices,
              testing::ElementsAre("auto", "rgb", "x", "y", "z", "flat", "intensity"));
}

TEST_F(CloudPicture, HoldsAFieldsRangeOverTimeWhicheverWayItCame) {
  const auto dataset = DatasetBuilder()
                           .topic("/tf", ObjectType::FrameTransforms)
                           .transform(0, "map", "lidar")
                           .topic("/points", ObjectType::PointCloud)
                           .at(1_s, threePoints({0, 0, 0}, {0, 50, 100}))
                           .at(2_s, threePoints({0, 0, 0}, {50, 50, 1000}))
                           .build();
  open(dataset, "map");
  add("/points", kBig);
  const auto later = drawThree(2_s);
  expectNear(later[0], colorAt("viridis", 0.5));
  expectNear(later[2], colorAt("viridis", 1.0));
  expectNear(drawThree(1_s)[1], colorAt("viridis", 0.5));
  EXPECT_EQ(drawThree(2_s), later);
}

TEST_F(CloudPicture, TakesManualPercentileAndReversedRanges) {
  open(datasetOf(threePoints({0, 0, 0}, {0, 50, 1000})), "map");
  auto& layer = add("/points", with(kBig, {{"range_mode", "manual"}, {"range_min", "0"}, {"range_max", "100"}}));
  expectNear(drawThree()[1], colorAt("viridis", 0.5));
  ASSERT_TRUE(layer.applySettings({{"range_max", "200"}, {"reverse_colormap", "true"}}));
  expectNear(drawThree()[1], colorAt("viridis", 0.75));
  ASSERT_TRUE(layer.applySettings({{"reverse_colormap", "false"},
                                   {"range_mode", "percentile"},
                                   {"percentile_low", "0"},
                                   {"percentile_high", "50"}}));
  expectNear(drawThree()[1], colorAt("viridis", 1.0));
  ASSERT_TRUE(layer.applySettings({{"range_mode", "manual"}, {"range_min", "7"}, {"range_max", "7"}}));
  expectNear(drawThree()[2], colorAt("viridis", 0.5));
}

TEST_F(CloudPicture, GivesNanFieldsTheirOwnColourAndDropsNanPoints) {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  auto cloud = threePoints({0, 0, kNowhere}, {kNowhere, 5, 6});
  open(datasetOf(std::move(cloud)), "map");
  const auto& layer = add("/points", with(kBig, {{"missing_color", "#ff00ff"}}));
  const auto colors = drawThree();
  expectNear(colors[0], {255, 0, 255}, 1);
  expectNear(colors[2], {0, 0, 0}, 0);
  EXPECT_EQ(layer.status().level, scenegraph::StatusLevel::Info);
  EXPECT_EQ(layer.status().code, "PointsDropped");
  EXPECT_THAT(layer.status().message, HasSubstr("1 of 3 points"));
  EXPECT_EQ(layer.counts(), (scenegraph::LayerCounts{{"points", 2}, {"dropped", 1}, {"bytes", 48}}));
}

TEST_F(CloudPicture, SaysWhyACloudIsNotDrawn) {
  auto cloud = threePoints({0, 0, 0}, {1, 2, 3});
  cloud.data.bytes = cloud.data.bytes.first(47);
  const auto dataset = DatasetBuilder()
                           .topic("/tf", ObjectType::FrameTransforms)
                           .transform(0, "map", "lidar")
                           .topic("/points", ObjectType::PointCloud)
                           .at(1_s, threePoints({0, 0, 0}, {1, 2, 3}))
                           .at(2_s, std::move(cloud))
                           .build();
  open(dataset, "map");
  const auto& layer = add("/points", kBig);
  EXPECT_GT(drawnPixels(draw(1_s, fromAbove())), 200);
  EXPECT_EQ(drawnPixels(draw(2_s, fromAbove())), 0) << "nothing stale";
  EXPECT_EQ(layer.status().level, scenegraph::StatusLevel::Error);
  EXPECT_EQ(layer.status().code, "MalformedCloud");
  EXPECT_THAT(layer.status().message, HasSubstr("/points"));
  EXPECT_THAT(layer.status().message, HasSubstr("47 bytes"));
  EXPECT_EQ(drawnPixels(draw(0, fromAbove())), 0);
  EXPECT_EQ(layer.status().code, "NoMessage");
  scene_->setFixedFrame("nowhere");
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
  EXPECT_EQ(layer.status().code, "UnknownTarget");
}

TEST_F(CloudPicture, DrawsSamePixelsAtAnEcefOffset) {
  // The same little scene at the origin and on the earth's surface: cloud, axes and lines.
  const auto build = [](const glm::dvec3& offset) {
    CloudBuilder builder("lidar");
    builder.xyz();
    for (int i = 0; i < 400; ++i) {
      builder.point({-9.5 + 0.93 * (i % 20), -9.5 + 0.95 * (i / 20), 0.013 * i});
    }
    return DatasetBuilder()
        .topic("/tf", ObjectType::FrameTransforms)
        .transform(0, "earth", "map", {.translation = offset})
        .transform(0, "map", "base", turn(0.3, 2, 1, 0.5))
        .transform(0, "base", "lidar", turn(-0.2, -1, 0.5, 0.25))
        .topic("/points", ObjectType::PointCloud)
        .at(1_s, builder.build())
        .build();
  };
  const glm::dvec3 offset{4'177'000.25, 858'000.5, 4'727'000.125};
  std::array<scenegraph::BytePicture, 2> pictures;
  for (std::size_t i = 0; i < 2; ++i) {
    const glm::dvec3 at = i == 0 ? glm::dvec3(0.0) : offset;
    open(build(at), "earth");
    add("/points", {{"color_field", "z"}, {"point_size", "5"}});
    add("tf", {{"axis_length", "2"}, {"hidden_frames", "map, earth"}});
    scenegraph::CameraView view;
    view.eye_from_fixed = scenegraph::lookAt(at + glm::dvec3{3, -12, 14}, at + glm::dvec3{1, 0, 0}, {0, 0, 1});
    pictures[i] = draw(1_s, view);
    scene_.reset();
  }
  EXPECT_GT(drawnPixels(pictures[0]), 2000);
  int differing = 0;
  int largest = 0;
  for (std::size_t i = 0; i < pictures[0].rgb.size(); ++i) {
    const int difference = std::abs(pictures[0].rgb[i] - pictures[1].rgb[i]);
    differing += difference > 0 ? 1 : 0;
    largest = std::max(largest, difference);
  }
  EXPECT_EQ(differing, 0) << "largest difference " << largest;
}

TEST_F(CloudPicture, KeepsFarCloudsOfFloatsSharp) {
  // Coordinates of 4e6 m inside the cloud itself: a centimetre apart on the screen as at the origin.
  std::array<scenegraph::BytePicture, 2> pictures;
  for (std::size_t i = 0; i < 2; ++i) {
    const double x = i == 0 ? 0.0 : 4'000'000.0;
    CloudBuilder builder("map");
    builder.field("x", FieldType::Float64).field("y", FieldType::Float64).field("z", FieldType::Float64);
    for (int k = 0; k < 10; ++k) {
      builder.point({x + 0.01 * k, 0.01 * k, 0});
    }
    open(datasetOf(builder.build()), "map");
    add("/points", {{"color_field", "x"}, {"point_size", "3"}});
    scenegraph::CameraView view = fromAbove(x + 0.045, 0.045, 5);
    view.vertical_extent_m = 0.2;
    pictures[i] = draw(1_s, view);
  }
  EXPECT_EQ(drawnPixels(pictures[0]), 90);
  EXPECT_EQ(drawnPixels(pictures[1]), 90);
}

TEST_F(CloudPicture, ColourChangesUploadNothingAndFieldChangesTouchNoPosition) {
  auto cloud = threePoints({0, 1, 2}, {1, 2, 3});
  open(datasetOf(std::move(cloud)), "map");
  auto& layer = add("/points", kBig);
  (void)draw(1_s, fromAbove());
  const auto geometry = [&] {
    auto* node = scene_->frames().node("lidar")->getChild(0)->asGroup();
    return node->getChild(0)->asDrawable()->asGeometry();
  };
  const osg::Array* positions = geometry()->getVertexArray();
  const osg::Array* values = geometry()->getVertexAttribArray(6);
  const unsigned positions_count = positions->getModifiedCount();
  const unsigned values_count = values->getModifiedCount();
  ASSERT_TRUE(layer.applySettings({{"colormap", "plasma"},
                                   {"range_mode", "manual"},
                                   {"range_max", "17"},
                                   {"point_size", "4"},
                                   {"opacity", "0.5"}}));
  (void)draw(1_s, fromAbove());
  EXPECT_EQ(geometry()->getVertexArray(), positions);
  EXPECT_EQ(geometry()->getVertexAttribArray(6), values);
  EXPECT_EQ(values->getModifiedCount(), values_count);
  ASSERT_TRUE(layer.applySettings({{"color_field", "z"}}));
  (void)draw(1_s, fromAbove());
  EXPECT_EQ(geometry()->getVertexArray(), positions);
  EXPECT_EQ(positions->getModifiedCount(), positions_count);
  EXPECT_NE(positions->getVertexBufferObject(), values->getVertexBufferObject());
}

TEST_F(CloudPicture, BlendsWhenNotOpaque) {
  open(datasetOf(threePoints({0, 0, 0}, {1, 2, 3})), "map");
  add("/points", with(kBig, {{"color_field", "flat"}, {"flat_color", "#ffffff"}, {"opacity", "0.5"}}));
  // Half of scene-linear white is 188 in sRGB.
  expectNear(drawThree()[1], {188, 188, 188});
}

TEST_F(CloudPicture, SaysWhichFieldsThereAreWhenOneIsUnknown) {
  open(datasetOf(threePoints({0, 0, 0}, {1, 2, 3})), "map");
  const auto& layer = add("/points", with(kBig, {{"color_field", "reflectivity"}}));
  EXPECT_GT(drawnPixels(draw(1_s, fromAbove())), 200);
  EXPECT_EQ(layer.status().code, "UnknownField");
  EXPECT_THAT(layer.status().message, HasSubstr("x, y, z, intensity"));
}

}  // namespace
}  // namespace stillframe::test
