#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "scenegraph/objects/robot_description.h"
#include "scenegraph/objects/scene_entities.h"
#include "scenegraph/passes/view_effects.h"
#include "tests/nodes/grid_map_builder.h"
#include "tests/nodes/occupancy_grid/grid_builder.h"
#include "tests/nodes/robot_scene.h"
#include "tests/nodes/scene_picture.h"
#include "tests/nodes/voxel_grid/voxel_builder.h"

namespace stillframe::test {
namespace {

using scenegraph::ObjectType;

/// Which colours of real layers exposure and tone mapping touch.
class GradedColors : public ScenePictureTest {
 protected:
  void SetUp() override {
    ScenePictureTest::SetUp();
    open(robotAt({0, 0, 0}), "map");
  }
  scenegraph::BytePicture drawWith(const scenegraph::SettingTexts& tone) {
    scenegraph::ViewEffects effects;
    effects.setOn("tonemap", !tone.empty());
    EXPECT_TRUE(effects.apply("tonemap", tone));
    return draw(1_s, {.eye_from_fixed = scenegraph::lookAt({3.5, -5.0, 4.0}, {0, 0, 0.3}, {0, 0, 1})}, 160, 120,
                effects.chain());
  }
  static double sum(const scenegraph::BytePicture& picture) {
    return std::accumulate(picture.rgb.begin(), picture.rgb.end(), 0.0);
  }
};

TEST_F(GradedColors, ALegendsColoursAreTheSameUnderEveryToneMapper) {
  add("grid");
  add("tf", {{"axis_length", "0.8"}, {"hidden_frames", "utm"}});
  scenegraph::Layer& cloud = add("/points", {{"color_field", "z"}, {"point_size", "3"}});
  for (const scenegraph::SettingTexts& settings :
       {scenegraph::SettingTexts{}, {{"colormap", "viridis"}, {"color_field", "intensity"}}, {{"opacity", "0.5"}}}) {
    ASSERT_TRUE(cloud.applySettings(settings));
    const auto plain = drawWith({});
    ASSERT_GT(drawnPixels(plain), 3000);
    for (const char* curve : {"none", "aces", "neutral"}) {
      for (const char* exposure : {"-4", "0", "1.5", "8"}) {
        EXPECT_EQ(drawWith({{"curve", curve}, {"exposure", exposure}}), plain) << curve << ' ' << exposure;
      }
    }
  }
}

TEST_F(GradedColors, SoAreThoseOfGridsVoxelsAndLines) {
  const auto ramp = [](auto column, auto row) { return static_cast<double>(column) + 0.1 * static_cast<double>(row); };
  DatasetBuilder builder = robotBuilderAt({0, 0, 0});
  builder.topic("/elevation", ObjectType::GridMap)
      .at(1_s, GridMapBuilder(6, 5).origin(translate(-3, -2, 0)).layer("height", ramp).build())
      .topic("/map", ObjectType::OccupancyGrid)
      .at(1_s, makeGrid(3, {0, 20, 40, 60, 80, 100, -1, 50, 0}))
      .topic("/voxels", ObjectType::VoxelGrid)
      .at(1_s, VoxelBuilder(3, 3, 2)
                   .field("cost", scenegraph::FieldType::Float32,
                          [](auto x, auto y, auto z) { return static_cast<double>(x + y + z); })
                   .build());
  open(builder.build(), "map");
  for (const auto& [topic, settings] : std::vector<std::pair<std::string, scenegraph::SettingTexts>>{
           {"/elevation", {}}, {"/map", {}}, {"/voxels", {}}, {"/path", {}}}) {
    scenegraph::Layer& layer = add(topic, settings);
    const auto plain = drawWith({});
    ASSERT_GT(drawnPixels(plain), 100) << topic;
    for (const char* curve : {"none", "aces", "neutral"}) {
      EXPECT_EQ(drawWith({{"curve", curve}, {"exposure", "2"}}), plain) << topic << ' ' << curve;
    }
    layer.setVisible(false);
  }
}

TEST_F(GradedColors, LitSurfacesAreGradedWhereTheyAreOpaque) {
  scenegraph::SceneEntities bodies;
  scenegraph::SceneEntity entity;
  entity.frame_id = "map";
  entity.id = "all";
  constexpr scenegraph::EntityColor kBrown{0.5F, 0.3F, 0.2F, 1.0F};
  entity.cubes.push_back({.pose = translate(-1, 0, 0), .size = glm::dvec3(1), .color = kBrown});
  entity.spheres.push_back({.pose = translate(1, 0, 0), .size = glm::dvec3(1), .color = kBrown});
  bodies.steps.push_back({false, 0});
  bodies.entities.push_back(std::move(entity));
  DatasetBuilder builder = robotBuilderAt({0, 0, 0});
  builder.topic("/scene", ObjectType::SceneEntities)
      .at(1_s, bodies)
      .topic("/robot_description", ObjectType::RobotDescription)
      .at(0, scenegraph::RobotDescription{
                 .format = "urdf",
                 .text = R"(<robot name="r"><link name="base"><visual><geometry><box size="1 1 1"/></geometry>
<material name="m"><color rgba="0.4 0.4 0.4 1"/></material></visual></link></robot>)"});
  open(builder.build(), "map");
  for (const char* topic : {"/scene", "/robot_description"}) {
    scenegraph::Layer& layer = add(topic);
    const auto plain = drawWith({});
    ASSERT_GT(drawnPixels(plain), 100) << topic;
    EXPECT_GT(sum(drawWith({{"curve", "none"}, {"exposure", "1"}})), 1.2 * sum(plain)) << topic;
    EXPECT_LT(sum(drawWith({{"curve", "none"}, {"exposure", "-1"}})), 0.8 * sum(plain)) << topic;
    EXPECT_EQ(drawWith({{"curve", "none"}, {"exposure", "0"}}), plain) << topic;
    // What one can see through is laid over the picture as it is, and so is all of it once the layer is translucent.
    ASSERT_TRUE(layer.applySettings({{"opacity", "0.5"}}));
    const auto translucent = drawWith({});
    EXPECT_EQ(drawWith({{"curve", "none"}, {"exposure", "2"}}), translucent) << topic;
    ASSERT_TRUE(layer.applySettings({{"opacity", "1"}}));
    EXPECT_EQ(drawWith({}), plain) << topic;
    layer.setVisible(false);
  }
}

TEST_F(GradedColors, ValuesThatAreNoNumbersLeaveNoneInThePicture) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  CloudBuilder cloud("map");
  cloud.xyz().field("value", scenegraph::FieldType::Float32).field("rgb", scenegraph::FieldType::Float32);
  int i = 0;
  for (const double value : {kNan, -kNan, 1e38, -1e38, 3.4e38, 1.0 / 0.0, -1.0 / 0.0, 0.0, 1.0, 1e-45}) {
    cloud.point({0.3 * i - 1.5, 0.2 * (i % 3), 0.1 * i, value, value});
    ++i;
  }
  DatasetBuilder builder;
  builder.topic("/tf", ObjectType::FrameTransforms).transform(0, "map", "base");
  open(builder.topic("/points", ObjectType::PointCloud).at(1_s, cloud.build()).build(), "map");
  scenegraph::Layer& layer = add("/points", {{"point_size", "9"}});
  scenegraph::ViewEffects all;
  for (const scenegraph::EffectType& type : scenegraph::effectTypes()) {
    all.setOn(type.name, true);
  }
  for (const char* field : {"value", "rgb", "z"}) {
    ASSERT_TRUE(layer.applySettings({{"color_field", field}}));
    for (const char* mode : {"fxaa", "msaa", "ssaa"}) {
      ASSERT_TRUE(all.apply("aa", {{"mode", mode}, {"samples", "2"}}));
      scene_->update(tf::TimePoint{1_s});
      const auto picture =
          renderer_->render(scene_->root(), {.eye_from_fixed = scenegraph::lookAt({0, -5, 3}, {0, 0, 0.3}, {0, 0, 1})},
                            {.width = 96, .height = 64, .background = {0, 0, 0, 1}, .post = all.chain()});
      ASSERT_TRUE(picture) << picture.error().message;
      EXPECT_TRUE(std::ranges::all_of(picture->rgba, [](float v) { return std::isfinite(v) && v >= 0.0F; }))
          << field << ' ' << mode;
      EXPECT_TRUE(std::ranges::any_of(picture->depth_m, [](float v) { return std::isfinite(v); })) << field;
    }
  }
}

TEST_F(GradedColors, PhotographicColoursAreGraded) {
  add("/points", {{"color_field", "rgb"}, {"point_size", "3"}});
  const double plain = sum(drawWith({}));
  EXPECT_GT(sum(drawWith({{"curve", "none"}, {"exposure", "1"}})), 1.2 * plain);
  EXPECT_LT(sum(drawWith({{"curve", "none"}, {"exposure", "-1"}})), 0.8 * plain);
  EXPECT_NE(sum(drawWith({{"curve", "aces"}})), plain);
}

}  // namespace
}  // namespace stillframe::test
