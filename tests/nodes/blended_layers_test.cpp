// What is translucent of several types in one scene: flat maps, and markers that run through them.
#include <algorithm>
#include <cmath>

#include "scenegraph/srgb.h"
#include "tests/nodes/grid_map_builder.h"
#include "tests/nodes/markers/marker_builder.h"
#include "tests/nodes/occupancy_grid/grid_builder.h"
#include "tests/nodes/picture_colors.h"
#include "tests/nodes/poses/poses_builder.h"

namespace stillframe::test {
namespace {

using scenegraph::BytePicture;
using scenegraph::ObjectType;
using scenegraph::PosesKind;

class BlendedLayers : public ScenePictureTest {
 protected:
  /// A white map in the plane z = 0, a red pane above it and a green one beneath, each letting half of the light
  /// through; an opaque blue line in the plane of the map.
  void openWorld() {
    auto map = makeUniformGrid(20, 20, 0);
    map.origin = translate(-10, -10, 0);
    SceneEntity above = cube("above", 0, 0, {1, 0, 0, 0.5F}, 10.0);
    SceneEntity beneath = cube("beneath", 0, 0, {0, 1, 0, 0.5F}, 10.0);
    above.cubes[0].pose.translation.z = 3.0;
    beneath.cubes[0].pose.translation.z = -3.0;
    above.cubes[0].size.z = beneath.cubes[0].size.z = 0.2;
    open(DatasetBuilder()
             .topic("/tf", ObjectType::FrameTransforms)
             .transform(0, "map", "base")
             .topic("/map", ObjectType::OccupancyGrid)
             .at(1_s, map)
             .topic("/slopes", ObjectType::GridMap)
             .at(1_s, GridMapBuilder(10, 10)
                          .layer("v", [](auto, auto) { return 0.0; })
                          .origin(translate(-10, -10, 0))
                          .build())
             .topic("/above", ObjectType::SceneEntities)
             .at(1_s, sceneOf({above}))
             .topic("/beneath", ObjectType::SceneEntities)
             .at(1_s, sceneOf({beneath}))
             .topic("/path", ObjectType::PosesInFrame)
             .at(1_s, pointsOf(PosesKind::Path, {{-9, 0, 0}, {9, 0, 0}}))
             .build(),
         "map");
  }
  static int byteOf(double light) { return scenegraph::srgbByteFromLinear(static_cast<float>(light)); }

  using SceneEntity = scenegraph::SceneEntity;
};

TEST_F(BlendedLayers, WhatLiesBeneathATranslucentMapIsSeenThroughItInAnyOrderOfLayers) {
  std::vector<std::string> order{"/above", "/beneath", "/map", "/path"};
  std::vector<BytePicture> pictures;
  do {
    openWorld();
    for (const std::string& topic : order) {
      add(topic, topic == "/map" ? scenegraph::SettingTexts{{"alpha", "0.5"}}
                 : topic == "/path"
                     ? scenegraph::SettingTexts{{"color", "#0000ff"}, {"line_width", "5"}, {"shape", "none"}}
                     : scenegraph::SettingTexts{});
    }
    pictures.push_back(draw(1_s, fromAbove()));
    EXPECT_TRUE(pictures.back().rgb == pictures.front().rgb) << testing::PrintToString(order);
  } while (std::ranges::next_permutation(order).found);
  const BytePicture& picture = pictures.front();
  expectNear(pixel(picture, 60, 120), {byteOf(0.75), byteOf(0.375), byteOf(0.25)}, 1);
  expectNear(pixel(picture, 60, 100), {byteOf(0.5), 0, byteOf(0.5)}, 1);  // the line, through the pane above it
  expectNear(pixel(picture, 20, 100), {0, 0, 255}, 1);                    // the line in the plane of the map
  expectNear(pixel(picture, 20, 120), {byteOf(0.5), byteOf(0.5), byteOf(0.5)}, 1);
}

TEST_F(BlendedLayers, FlatMapsOfOnePlaneKeepTheirOrderAmongOtherBlendedThings) {
  for (const int samples : {1, 4}) {
    scenegraph::PostChain post;
    post.msaa_samples = samples;
    openWorld();
    add("/slopes", {{"flat", "true"}, {"color_field", "flat"}, {"flat_color", "#0000ff"}, {"opacity", "0.5"}});
    auto& map = add("/map", {{"alpha", "0.5"}});
    add("/path", {{"color", "#ff00ff"}, {"line_width", "5"}, {"shape", "none"}});
    const BytePicture alone = draw(1_s, fromAbove(), 200, 200, post);
    EXPECT_EQ(renderer_->lastFrame().blended_bands, 0) << "flat things alone need no lists";
    add("/beneath");
    const BytePicture picture = draw(1_s, fromAbove(), 200, 200, post);
    EXPECT_EQ(renderer_->lastFrame().blended_bands, 1);
    // Blue over white, and beneath them green.
    expectNear(pixel(alone, 20, 120), {byteOf(0.25), byteOf(0.25), byteOf(0.75)}, 1);
    expectNear(pixel(picture, 20, 120), pixel(alone, 20, 120), 1);
    expectNear(pixel(picture, 60, 120), {byteOf(0.25), byteOf(0.375), byteOf(0.75)}, 1);
    expectNear(pixel(picture, 60, 100), {255, 0, 255}, 1);
    // Behind what is opaque nothing of them is seen.
    ASSERT_TRUE(map.applySettings({{"alpha", "1"}}));
    expectNear(pixel(draw(1_s, fromAbove(), 200, 200, post), 60, 120), {byteOf(0.5), byteOf(0.5), 255}, 1);
  }
}

}  // namespace
}  // namespace stillframe::test
