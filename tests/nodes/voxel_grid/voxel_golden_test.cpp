#include <gmock/gmock.h>

#include <cmath>

#include "tests/nodes/scene_picture.h"
#include "tests/nodes/voxel_grid/voxel_builder.h"
#include "tests/support/golden.h"
#include "tests/support/plain_viewer.h"

namespace stillframe::test {
namespace {

using scenegraph::FieldType;
using scenegraph::ObjectType;
using testing::AllOf;
using testing::Ge;
using testing::Le;

constexpr scenegraph::Color kBackground{.r = 0.12F, .g = 0.13F, .b = 0.15F, .a = 1.0F};

/// A bowl with a ball in it, on cells of 0.25 x 0.25 x 0.2 m; the value is the distance from the ball's middle. Colours
/// by position, a stripe of them half transparent.
std::shared_ptr<scenegraph::Dataset> ballInBowl() {
  const auto distance = [](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return std::hypot(0.25 * (x + 0.5) - 4.0, 0.25 * (y + 0.5) - 4.0, 0.2 * (z + 0.5) - 3.0);
  };
  const auto isSolid = [=](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const double r = distance(x, y, z);
    return r < 1.2 || (r > 2.5 && r < 3.2 && z < 12);
  };
  VoxelBuilder builder(32, 32, 20);
  builder.cell({0.25, 0.25, 0.2})
      .origin(turn(0.35, -4.0, -4.0, 0.0))
      .field("distance", FieldType::Float32,
             [=](auto x, auto y, auto z) { return isSolid(x, y, z) ? distance(x, y, z) : 0.0; })
      .field("red", FieldType::Uint8, [](auto x, auto, auto) { return 8.0 * x; })
      .field("green", FieldType::Uint8, [](auto, auto y, auto) { return 8.0 * y; })
      .field("blue", FieldType::Uint8, [](auto, auto, auto z) { return 12.0 * z; })
      .field("alpha", FieldType::Uint8, [](auto, auto, auto) { return 255.0; });
  return DatasetBuilder()
      .topic("/tf", ObjectType::FrameTransforms)
      .transform(0, "map", "base")
      .topic("/voxels", ObjectType::VoxelGrid)
      .at(1_s, builder.build())
      .build();
}

scenegraph::CameraView fromTheSide() {
  return {.eye_from_fixed = scenegraph::lookAt({-6.0, -7.0, 7.5}, {-0.8, 0.8, 1.2}, {0, 0, 1})};
}

class VoxelGolden : public ScenePictureTest {
 protected:
  void SetUp() override {
    ScenePictureTest::SetUp();
    open(ballInBowl(), "map");
  }
};

TEST_F(VoxelGolden, ByAField) {
  const auto& layer = add("/voxels", {{"color_field", "distance"}, {"colormap", "turbo"}});
  const auto picture = draw(1_s, fromTheSide(), 320, 240);
  EXPECT_EQ(layer.status().code, "Ok") << layer.status().message;
  EXPECT_EQ(layer.counts()[0].second, 32U * 32 * 20);
  EXPECT_THAT(layer.counts()[1].second, 2836U);
  EXPECT_TRUE(matchesGolden(picture, "voxel_grid"));
  EXPECT_THAT(drawnPixels(picture), AllOf(Ge(11000), Le(15000)));
}

TEST_F(VoxelGolden, InTheirOwnColours) {
  add("/voxels", {{"draw_if", "range"}, {"draw_from", "0.1"}, {"draw_to", "3"}});
  const auto picture = draw(1_s, fromTheSide(), 320, 240);
  EXPECT_TRUE(matchesGolden(picture, "voxel_grid_rgb"));
  EXPECT_THAT(drawnPixels(picture), AllOf(Ge(11000), Le(15000)));
}

TEST_F(VoxelGolden, IsTheSameInAPlainViewer) {
  auto& layer = add("/voxels");
  for (const char* const color : {"distance", "rgb", "z"}) {
    ASSERT_TRUE(layer.applySettings({{"color_field", color}}));
    scene_->update(tf::TimePoint{1_s});
    const auto ours = scenegraph::toBytes(
        render(scene_->root(), fromTheSide(), {.width = 320, .height = 240, .background = kBackground}));
    for (const char* const extension : kExportExtensions) {
      const osg::ref_ptr<osg::Node> back = exportedAndRead(scene_->root(), extension);
      ASSERT_TRUE(back.valid());
      const auto plain = drawPlainly(*back, fromTheSide(), 0.1, 100.0, 320, 240, kBackground);
      const osg::ref_ptr<osg::Group> nothing = new osg::Group;
      const auto empty = drawPlainly(*nothing, fromTheSide(), 0.1, 100.0, 320, 240, kBackground);
      EXPECT_GE(difference(plain, empty).pixels, 11000U) << color << extension;
      EXPECT_LE(difference(ours, plain).beyond_one, 5U) << color << extension << ": sides at one depth";
    }
  }
}

}  // namespace
}  // namespace stillframe::test
