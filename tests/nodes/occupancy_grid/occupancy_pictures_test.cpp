#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>

#include "tests/nodes/occupancy_grid/grid_builder.h"
#include "tests/nodes/scene_picture.h"

namespace stillframe::test {
namespace {

using scenegraph::ObjectType;
using scenegraph::StatusLevel;
using testing::HasSubstr;

DatasetBuilder onMap() {
  DatasetBuilder builder;
  builder.topic("/tf", ObjectType::FrameTransforms).transform(0, "map", "base");
  return builder;
}

class OccupancyPicture : public ScenePictureTest {
 protected:
  void openGrid(const scenegraph::OccupancyGrid& grid) {
    open(onMap().topic("/map", ObjectType::OccupancyGrid).at(1_s, grid).build(), "map");
  }
  /// Colour at the middle of a cell of 1 m whose grid lies at the origin; 10 pixels a metre.
  static Bytes3 cell(const scenegraph::BytePicture& picture, int column, int row) {
    return pixel(picture, 105 + 10 * column, 94 - 10 * row);
  }
};

// Free, half, occupied, unknown; 1, 98, 99, 100; 101, 127, -2, -128; a lone cell, to see the orientation.
const std::vector<std::int8_t> kValues = {0, 50, 100, -1, 1, 98, 99, 100, 101, 127, -2, -128, 0, 0, 0, 100};

TEST_F(OccupancyPicture, DrawsTheSchemesCellByCell) {
  openGrid(makeGrid(4, kValues));
  auto& layer = add("/map");
  const auto map = draw(1_s, fromAbove());
  const Bytes3 white{255, 255, 255};
  const Bytes3 black{0, 0, 0};
  const Bytes3 unknown{112, 137, 134};
  EXPECT_EQ(cell(map, 0, 0), white);
  EXPECT_EQ(cell(map, 1, 0), (Bytes3{128, 128, 128}));
  EXPECT_EQ(cell(map, 2, 0), black);
  EXPECT_EQ(cell(map, 3, 0), unknown);
  EXPECT_EQ(cell(map, 0, 1), (Bytes3{253, 253, 253}));
  EXPECT_EQ(cell(map, 0, 2), (Bytes3{0, 255, 0})) << "101";
  EXPECT_EQ(cell(map, 1, 2), (Bytes3{0, 255, 0})) << "127";
  EXPECT_EQ(cell(map, 2, 2), (Bytes3{255, 255, 0})) << "-2";
  EXPECT_EQ(cell(map, 3, 2), (Bytes3{255, 0, 0})) << "-128";
  EXPECT_EQ(cell(map, 0, 3), white);
  EXPECT_EQ(cell(map, 3, 3), black);
  EXPECT_EQ(drawnPixels(map), 1600 - 300) << "16 cells of 100 pixels, three of them black";
  EXPECT_EQ(layer.status(), scenegraph::Status{});
  EXPECT_EQ(layer.counts(),
            (scenegraph::LayerCounts{{"cells", 16}, {"unknown", 1}, {"occupied", 5}, {"invalid", 4}, {"updates", 0}}));
  const osg::BoundingBoxd box = layer.boundsInFixed();
  EXPECT_EQ(box._max, osg::Vec3d(4, 4, 0));

  ASSERT_TRUE(layer.applySettings({{"color_scheme", "costmap"}}));
  const auto costmap = draw(1_s, fromAbove());
  EXPECT_EQ(cell(costmap, 0, 0), black) << "transparent";
  EXPECT_EQ(cell(costmap, 1, 0), (Bytes3{127, 0, 128}));
  EXPECT_EQ(cell(costmap, 2, 0), (Bytes3{255, 0, 255}));
  EXPECT_EQ(cell(costmap, 3, 0), unknown);
  EXPECT_EQ(cell(costmap, 0, 1), (Bytes3{2, 0, 253}));
  EXPECT_EQ(cell(costmap, 1, 1), (Bytes3{249, 0, 6}));
  EXPECT_EQ(cell(costmap, 2, 1), (Bytes3{0, 255, 255}));
  EXPECT_EQ(cell(costmap, 3, 2), (Bytes3{255, 0, 0}));
  EXPECT_EQ(drawnPixels(costmap), 1200) << "four cells are 0";

  ASSERT_TRUE(layer.applySettings({{"color_scheme", "raw"}}));
  const auto raw = draw(1_s, fromAbove());
  EXPECT_EQ(cell(raw, 2, 0), (Bytes3{100, 100, 100}));
  EXPECT_EQ(cell(raw, 3, 0), white) << "-1 is byte 255";
  EXPECT_EQ(cell(raw, 3, 2), (Bytes3{128, 128, 128}));

  ASSERT_TRUE(layer.applySettings({{"color_scheme", "map"}, {"alpha", "0.5"}}));
  const auto half = draw(1_s, fromAbove());
  EXPECT_NEAR(cell(half, 0, 0)[0], 188, 2) << "half the light of white";
  EXPECT_EQ(cell(half, 2, 0), black);
}

TEST_F(OccupancyPicture, FollowsUpdatesInTimeAndBack) {
  const auto dataset = onMap()
                           .topic("/map", ObjectType::OccupancyGrid)
                           .at(1_s, makeUniformGrid(4, 4, 0))
                           .at(5_s, makeUniformGrid(2, 2, 0, "map", 2.0))
                           .topic("/map_updates", ObjectType::OccupancyGridUpdate)
                           .at(1_s, makePatch(3, 3, 1, {100}))
                           .at(2_s, makePatch(0, 0, 1, {100}))
                           .at(3_s, makePatch(-1, 0, 3, {-1, -1, -1, -1, -1, -1}))
                           .at(4_s, makePatch(9, 9, 1, {100}))
                           .at(6_s, makePatch(1, 1, 1, {100}, "odom"))
                           .build();
  open(dataset, "map");
  auto& layer = add("/map");
  const Bytes3 white{255, 255, 255};
  const Bytes3 black{0, 0, 0};
  const Bytes3 unknown{112, 137, 134};
  for (int round = 0; round < 2; ++round) {
    auto picture = draw(4_s, fromAbove());
    EXPECT_EQ(cell(picture, 0, 0), unknown);
    EXPECT_EQ(cell(picture, 1, 1), unknown);
    EXPECT_EQ(cell(picture, 2, 0), white);
    EXPECT_EQ(layer.status().code, "UpdatesRefused");
    EXPECT_THAT(layer.status().message, HasSubstr("1 x 1 cells at (9, 9) lie outside"));
    EXPECT_EQ(layer.counts().back().second, 2U);
    picture = draw(1_s, fromAbove());
    EXPECT_EQ(drawnPixels(picture), 1600) << "an update of the base's own moment came before it";
    EXPECT_EQ(layer.status(), scenegraph::Status{});
    picture = draw(7_s, fromAbove());
    EXPECT_EQ(cell(picture, 0, 0), white) << "the base of 5 s starts anew";
    EXPECT_EQ(cell(picture, 2, 2), black);
    EXPECT_EQ(layer.status().code, "UpdateFrameDiffers");
    picture = draw(2_s, fromAbove());
    EXPECT_EQ(cell(picture, 0, 0), black);
    EXPECT_EQ(cell(picture, 1, 1), white);
    picture = draw(3_s, fromAbove());
    EXPECT_EQ(layer.status().code, "UpdatesClipped");
  }
}

TEST_F(OccupancyPicture, TellsOfUpdatesWithoutAGrid) {
  const auto dataset = onMap()
                           .topic("/late", ObjectType::OccupancyGrid)
                           .at(5_s, makeUniformGrid(4, 4, 0))
                           .topic("/late_updates", ObjectType::OccupancyGridUpdate)
                           .at(1_s, makePatch(0, 0, 1, {100}))
                           .topic("/orphan_updates", ObjectType::OccupancyGridUpdate)
                           .at(1_s, makePatch(0, 0, 1, {100}))
                           .build();
  open(dataset, "map");
  scene_->addDefaultLayers();
  EXPECT_EQ(scene_->findLayer("/late_updates"), nullptr) << "they belong to /late";
  ASSERT_NE(scene_->findLayer("/orphan_updates"), nullptr);
  ASSERT_NE(scene_->findLayer("/late"), nullptr);
  (void)draw(2_s, fromAbove());
  EXPECT_EQ(scene_->findLayer("/orphan_updates")->layer->status().code, "UpdateWithoutBase");
  EXPECT_THAT(scene_->findLayer("/orphan_updates")->layer->status().message, HasSubstr("'/orphan'"));
  EXPECT_EQ(scene_->findLayer("/late")->layer->status().code, "UpdateBeforeBase");
  (void)draw(5_s, fromAbove());
  EXPECT_EQ(scene_->findLayer("/late")->layer->status(), scenegraph::Status{});
  EXPECT_EQ(scene_->findLayer("/late")->layer->counts().back().second, 0U);
}

TEST_F(OccupancyPicture, TurnsWithItsOriginAndTakesAnyResolution) {
  auto grid = makeGrid(2, {100, 0, 0, 0});
  grid.origin = turn(M_PI / 2, 3, 0);
  openGrid(grid);
  add("/map");
  auto picture = draw(1_s, fromAbove());
  // Turned left about (3, 0): x runs up, y to the left.
  EXPECT_EQ(cell(picture, 2, 0), (Bytes3{0, 0, 0}));
  EXPECT_EQ(cell(picture, 2, 1), (Bytes3{255, 255, 255}));
  EXPECT_EQ(cell(picture, 1, 0), (Bytes3{255, 255, 255}));
  EXPECT_EQ(drawnPixels(picture), 300);
  for (const double resolution_m : {1e-6, 1e6}) {
    grid = makeGrid(2, {100, 0, 0, 0}, "map", resolution_m);
    openGrid(grid);
    add("/map");
    scenegraph::CameraView view = fromAbove(0, 0, std::min(1e3, 10 * resolution_m));
    view.vertical_extent_m = 20 * resolution_m;
    picture = draw(1_s, view);
    EXPECT_NEAR(drawnPixels(picture), 300, 40) << resolution_m;
  }
}

TEST_F(OccupancyPicture, DrawsTwentyThousandCellsSquare) {
  constexpr std::uint32_t kSide = 20'000;
  constexpr std::size_t kCells = std::size_t{kSide} * kSide;
  // Pages of zeros take no memory until they are written to.
  const std::shared_ptr<std::byte> zeros(static_cast<std::byte*>(std::calloc(kCells, 1)), std::free);
  ASSERT_NE(zeros, nullptr);
  const auto fill = [&](std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height) {
    for (std::uint32_t row = y; row < y + height; ++row) {
      std::memset(zeros.get() + std::size_t{row} * kSide + x, 100, width);
    }
  };
  fill(19'000, 19'000, 1000, 1000);  // the last corner
  fill(5000, 0, 1000, 300);          // over the edge of two tiles
  fill(0, 12'345, 1, 1);             // smaller than a pixel
  scenegraph::OccupancyGrid grid;
  grid.frame_id = "map";
  grid.resolution_m = 0.001;
  grid.width = grid.height = kSide;
  grid.data = {{zeros.get(), kCells}, zeros};
  openGrid(grid);
  const auto& layer = add("/map");
  const auto picture = draw(1_s, fromAbove(10, 10));
  EXPECT_EQ(layer.status(), scenegraph::Status{});
  EXPECT_EQ(layer.counts()[0].second, kCells);
  EXPECT_EQ(layer.counts()[2].second, 1'300'001U);
  EXPECT_EQ(drawnPixels(picture), 200 * 200 - 10 * 10 - 10 * 3);
  EXPECT_EQ(pixel(picture, 199, 0), (Bytes3{0, 0, 0}));
  EXPECT_EQ(pixel(picture, 50, 199), (Bytes3{0, 0, 0}));
  EXPECT_EQ(pixel(picture, 59, 197), (Bytes3{0, 0, 0}));
  EXPECT_EQ(pixel(picture, 60, 197), (Bytes3{255, 255, 255}));
}

TEST_F(OccupancyPicture, SaysWhyAGridIsNotDrawn) {
  const auto statusOf = [&](const scenegraph::OccupancyGrid& grid) {
    openGrid(grid);
    auto& layer = add("/map");
    const auto picture = draw(1_s, fromAbove());
    if (layer.status().level >= StatusLevel::Warn) {
      EXPECT_EQ(drawnPixels(picture), 0);
    }
    return layer.status();
  };
  auto grid = makeUniformGrid(4, 4, 0);
  grid.width = 5;
  EXPECT_EQ(statusOf(grid).code, "MalformedGrid");
  EXPECT_THAT(statusOf(grid).message, HasSubstr("'/map' at 1.000000000 s: 5 x 4 cells need 20 bytes"));
  grid = makeUniformGrid(4, 4, 0);
  grid.resolution_m = 0;
  EXPECT_EQ(statusOf(grid).code, "BadResolution");
  grid.resolution_m = 1;
  grid.origin.rotation = {0, 0, 0, 0};
  EXPECT_EQ(statusOf(grid).code, "ZeroRotation");
  grid.origin.rotation = {2, 0, 0, 0};
  EXPECT_EQ(statusOf(grid).code, "UnnormalisedRotation");
  EXPECT_EQ(statusOf(makeGrid(0, {})).code, "EmptyGrid");
}

}  // namespace
}  // namespace stillframe::test
