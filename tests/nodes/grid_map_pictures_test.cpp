#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "nodes/points/colormap.h"
#include "tests/nodes/grid_map_builder.h"
#include "tests/nodes/scene_picture.h"
#include "tests/support/golden.h"
#include "tests/support/plain_viewer.h"

namespace stillframe::test {
namespace {

using scenegraph::GridMap;
using scenegraph::ObjectType;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void expectColor(const Bytes3& actual, const char* colormap, double t, double shade = 1.0) {
  const nodes::SrgbColor color = nodes::findColormap(colormap)->at(t);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(actual[i], color[i] * 255.0 * shade, 4) << testing::PrintToString(actual) << " at " << t;
  }
}

std::shared_ptr<scenegraph::Dataset> datasetOf(GridMap map) {
  return DatasetBuilder()
      .topic("/tf", ObjectType::FrameTransforms)
      .transform(0, "map", "base")
      .topic("/map", ObjectType::GridMap)
      .at(1_s, std::move(map))
      .build();
}

/// 16 x 16 cells about the origin of `map`: a rising plane, a cost in quarters with one missing, a hole in the heights.
GridMapBuilder scene() {
  GridMapBuilder builder(16, 16);
  builder.origin(translate(-8, -8, 0));
  builder.layer("elevation", [](auto column, auto row) { return column == 4 && row == 12 ? kNan : 0.1 * column; });
  builder.layer("cost",
                [](auto column, auto row) { return column < 8 ? (row < 8 ? 0.0 : 50.0) : (row < 8 ? 100.0 : kNan); });
  return builder;
}

class GridMapPicture : public ScenePictureTest {};

TEST_F(GridMapPicture, DrawsTheElevationColouredByItselfWithHoles) {
  open(datasetOf(scene().build()), "map");
  const auto& layer = add("/map", {{"shading", "false"}});
  const auto picture = draw(1_s, fromAbove());
  expectColor(pixel(picture, 30, 100), "viridis", 1 / 15.0);
  expectColor(pixel(picture, 165, 100), "viridis", 14 / 15.0);
  EXPECT_EQ(pixel(picture, 65, 55), (Bytes3{0, 0, 0})) << "the cell without a height, centre (-3.5, 4.5)";
  EXPECT_EQ(pixel(picture, 22, 100), (Bytes3{0, 0, 0})) << "outside the centres of the first column";
  EXPECT_NEAR(drawnPixels(picture), 150 * 150 - 200, 160) << "a hole of a rhombus of two square metres";
  EXPECT_EQ(layer.status(), scenegraph::Status{});
  EXPECT_EQ(layer.counts(), (scenegraph::LayerCounts{{"cells", 256}, {"triangles", 450 - 4}, {"bytes", 2048}}));
  const auto box = scene_->boundsInFixed();
  EXPECT_DOUBLE_EQ(box.xMin(), -7.5);
  EXPECT_NEAR(box.zMax(), 1.5, 1e-6);
}

TEST_F(GridMapPicture, ColoursTheSurfaceByAnotherLayer) {
  open(datasetOf(scene().build()), "map");
  auto& layer = add("/map", {{"shading", "false"}, {"color_field", "cost"}, {"missing_color", "#ff00ff"}});
  auto picture = draw(1_s, fromAbove());
  expectColor(pixel(picture, 50, 150), "viridis", 0.0);
  expectColor(pixel(picture, 40, 40), "viridis", 0.5);
  expectColor(pixel(picture, 150, 150), "viridis", 1.0);
  EXPECT_EQ(pixel(picture, 150, 50), (Bytes3{255, 0, 255}));
  ASSERT_TRUE(layer.applySettings({{"range_mode", "manual"}, {"range_max", "200"}, {"colormap", "viridis"}}));
  expectColor(pixel(draw(1_s, fromAbove()), 150, 150), "viridis", 0.5);
  ASSERT_TRUE(layer.applySettings({{"color_field", "nothing"}}));
  draw(1_s, fromAbove());
  EXPECT_EQ(layer.status().code, "UnknownField");
  EXPECT_THAT(layer.status().message, HasSubstr("elevation, cost"));
}

TEST_F(GridMapPicture, LiesFlatWithWholeCellsAndHolesWhereTheColourIsMissing) {
  open(datasetOf(scene().build()), "map");
  auto& layer = add("/map", {{"flat", "true"}, {"color_field", "cost"}});
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 160 * 160 - 80 * 80);
  EXPECT_EQ(scene_->boundsInFixed().zMax(), 0.0);
  ASSERT_TRUE(layer.applySettings({{"color_field", "elevation"}}));
  const auto picture = draw(1_s, fromAbove());
  EXPECT_EQ(drawnPixels(picture), 160 * 160 - 10 * 10);
  EXPECT_EQ(pixel(picture, 65, 55), (Bytes3{0, 0, 0}));
  expectColor(pixel(picture, 175, 100), "viridis", 1.0);
}

TEST_F(GridMapPicture, SaysWhyNothingIsSeen) {
  const auto code = [&](const scenegraph::GridMap& map, const scenegraph::SettingTexts& settings = {}) {
    open(datasetOf(map), "map");
    const auto& layer = add("/map", settings);
    EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
    return layer.status().code;
  };
  const auto nothing = [](auto, auto) { return std::numeric_limits<double>::quiet_NaN(); };
  EXPECT_EQ(code(GridMapBuilder(8, 8).layer("elevation", nothing).build()), "NothingDrawn");
  EXPECT_EQ(code(GridMapBuilder(8, 8).layer("elevation", nothing).build(), {{"flat", "true"}}), "NothingDrawn");
  EXPECT_EQ(code(GridMapBuilder(0, 0).layer("elevation", nothing).build()), "EmptyGrid");
}

TEST_F(GridMapPicture, ShadesSlopesByTheirNormals) {
  GridMapBuilder builder(16, 16);
  builder.origin(translate(-8, -8, 0)).layer("elevation", [](auto column, auto) { return std::abs(column - 7.5); });
  open(datasetOf(builder.build()), "map");
  auto& layer = add("/map", {{"color_field", "flat"}, {"flat_color", "#c8c8c8"}});
  const auto picture = draw(1_s, fromAbove(0, 0, 100));
  const double towards = 0.4 + 0.6 * (0.267 + 0.895) / std::sqrt(2.0);
  const double away = 0.4 + 0.6 * (0.895 - 0.267) / std::sqrt(2.0);
  EXPECT_NEAR(pixel(picture, 50, 100)[0], 200 * towards, 3) << "the west side falls to the east, towards the light";
  EXPECT_NEAR(pixel(picture, 150, 100)[0], 200 * away, 3);
  ASSERT_TRUE(layer.applySettings({{"opacity", "0.5"}, {"shading", "false"}}));
  EXPECT_NEAR(pixel(draw(1_s, fromAbove(0, 0, 100)), 50, 100)[0], 146, 3) << "half of its light over black";
}

TEST_F(GridMapPicture, PlacesARotatedOriginAndFarHeights) {
  GridMapBuilder builder(8, 4);
  builder.origin(turn(std::numbers::pi / 2, 2, -4, 0)).layer("elevation", [](auto column, auto) {
    return 5e5 + column;
  });
  open(datasetOf(builder.build()), "map");
  add("/map", {{"shading", "false"}, {"colormap", "viridis"}});
  const auto picture = draw(1_s, fromAbove(0, 0, 500'100));
  EXPECT_EQ(drawnPixels(picture), 30 * 70) << "x of the map runs along y";
  expectColor(pixel(picture, 100, 134), "viridis", 0.0);
  expectColor(pixel(picture, 100, 66), "viridis", 1.0);
  EXPECT_NEAR(scene_->boundsInFixed().zMin(), 5e5, 1e-3);
}

TEST_F(GridMapPicture, DrawsCellColoursWithTheirAlpha) {
  GridMap map = GridMapBuilder(2, 1).layer("v", [](auto, auto) { return 0.0; }).build();
  const auto bytes = std::make_shared<std::vector<std::byte>>();
  for (const int value : {200, 100, 50, 255, 200, 100, 50, 0}) {
    bytes->push_back(static_cast<std::byte>(value));
  }
  using enum scenegraph::FieldType;
  map.fields = {{"red", 0, Uint8}, {"green", 1, Uint8}, {"blue", 2, Uint8}, {"alpha", 3, Uint8}};
  map.cell_stride = 4;
  map.row_stride = 8;
  map.cell_size_m = {5, 5};
  map.data = {*bytes, bytes};
  open(datasetOf(std::move(map)), "map");
  add("/map");
  const auto picture = draw(1_s, fromAbove());
  EXPECT_EQ(pixel(picture, 120, 80), (Bytes3{200, 100, 50}));
  EXPECT_EQ(drawnPixels(picture), 50 * 50) << "the other cell is transparent";
}

/// A hill beside a pit, coloured by a cost with a missing corner, and what it looks like in a stock viewer.
class GridMapGolden : public ScenePictureTest {
 protected:
  void openHill() {
    GridMapBuilder builder(80, 60);
    builder.origin(turn(0.3, -7, -6, 0));
    builder.layer("elevation", [](auto column, auto row) {
      const double x = (column - 30.0) / 12;
      const double y = (row - 30.0) / 12;
      const bool is_hole = column >= 60 && column < 66 && row >= 20 && row < 26;
      return is_hole ? kNan : 2.2 * std::exp(-x * x - y * y) - 1.2 * std::exp(-(x - 3) * (x - 3) - y * y);
    });
    builder.layer("cost", [](auto column, auto row) { return column + row < 25 ? kNan : (column % 20) * 5.0; });
    auto map = builder.build();
    map.cell_size_m = {0.2, 0.2};
    open(datasetOf(std::move(map)), "map");
    add("grid");
    add("/map", {{"color_field", "cost"}, {"colormap", "viridis"}, {"missing_color", "#c80000"}});
  }
  const scenegraph::CameraView view_{.eye_from_fixed = scenegraph::lookAt({6, -9, 8}, {-1.5, 1, 0}, {0, 0, 1})};
};

TEST_F(GridMapGolden, AHillWithHolesAndAMissingCorner) {
  openHill();
  const auto picture = draw(1_s, view_, 320, 240);
  EXPECT_TRUE(matchesGolden(picture, "grid_map"));
  int red = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      const Bytes3 color = pixel(picture, x, y);
      red += color[0] > 60 && color[1] == 0 && color[2] == 0 ? 1 : 0;
    }
  }
  EXPECT_GT(red, 500) << "cells without a cost";
  EXPECT_LT(red, 4000);
  EXPECT_GT(drawnPixels(picture), 15000);
  const auto box = scene_->findLayer("/map")->layer->boundsInFixed();
  EXPECT_NEAR(box.zMax(), 2.2, 0.01);
  EXPECT_NEAR(box.zMin(), -1.2, 0.03);
  EXPECT_EQ(scene_->findLayer("/map")->layer->counts()[1].second, 2U * 79 * 59 - 2 * 49 + 4);
}

TEST_F(GridMapGolden, IsTheSameInAPlainViewer) {
  openHill();
  for (const char* const flat : {"false", "true"}) {
    ASSERT_TRUE(scene_->findLayer("/map")->layer->applySettings({{"flat", flat}}));
    const auto ours = draw(1_s, view_, 320, 240);
    for (const char* const extension : kExportExtensions) {
      const osg::ref_ptr<osg::Node> back = exportedAndRead(scene_->root(), extension);
      ASSERT_TRUE(back.valid());
      const auto plain = drawPlainly(*back, view_, 0.1, 100.0, 320, 240, {.r = 0, .g = 0, .b = 0, .a = 1});
      const auto differs = difference(ours, plain);
      EXPECT_LE(differs.beyond_one, 100U) << extension << ", flat " << flat << ": largest " << differs.largest;
      EXPECT_GT(drawnPixels(plain), 15000);
    }
  }
}

}  // namespace
}  // namespace stillframe::test
