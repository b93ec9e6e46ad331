#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "nodes/grid_map/map_cells.h"
#include "nodes/points/channel.h"
#include "tests/nodes/grid_map_builder.h"

namespace stillframe::test {
namespace {

using scenegraph::FieldType;
using scenegraph::GridMap;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string codeOf(const GridMap& map) {
  const auto cells = nodes::readMapCells(map);
  return cells ? std::string("Ok") : cells.error().code;
}

struct Surface {
  std::vector<float> positions;
  std::vector<std::int8_t> normals;
  std::vector<std::uint32_t> triangles;
};

Surface surfaceOf(const GridMap& map) {
  const auto cells = nodes::readMapCells(map);
  EXPECT_TRUE(cells);
  std::vector<float> heights(cells->all.points);
  const auto limits = nodes::convertChannel(cells->records, cells->all, cells->layers.front(), heights);
  Surface surface;
  surface.positions.resize(3 * heights.size());
  surface.normals.resize(4 * heights.size());
  nodes::buildSurface(map, heights, limits.offset, 0.0, {surface.positions, surface.normals, surface.triangles});
  return surface;
}

TEST(MapCells, ReadsLayersThroughPaddedStrides) {
  for (const std::uint32_t padding : {0U, 3U, 16U}) {
    const GridMap map = GridMapBuilder(3, 2, padding)
                            .layer("elevation", [](auto column, auto row) { return column + 10.0 * row; })
                            .layer("cost", [](auto column, auto) { return column == 0 ? kNan : 5.0; })
                            .build();
    const auto cells = nodes::readMapCells(map);
    ASSERT_TRUE(cells);
    std::vector<float> values(6);
    const auto limits = nodes::convertChannel(cells->records, cells->all, cells->layers[0], values);
    EXPECT_THAT(values, ElementsAre(0, 1, 2, 10, 11, 12)) << padding;
    EXPECT_EQ(limits.high, 12.0);
    EXPECT_EQ(nodes::convertChannel(cells->records, cells->all, cells->layers[1], values).finite, 4U);
    EXPECT_EQ(values[3], nodes::kMissingValue);
  }
}

TEST(MapCells, ReadsEveryFieldType) {
  using enum FieldType;
  for (const FieldType type : {Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64}) {
    GridMap map = GridMapBuilder(1, 1).layer("v", [](auto, auto) { return 0.0; }).build();
    map.fields = {{"v", 1, type}};
    map.cell_stride = 9;
    map.row_stride = 9;
    const auto bytes = std::make_shared<std::vector<std::byte>>(9);
    map.data = {*bytes, bytes};
    EXPECT_EQ(codeOf(map), "Ok");
    map.fields[0].offset = 9 - scenegraph::byteSize(type) + 1;
    EXPECT_EQ(codeOf(map), "MalformedGrid") << "one byte past the end";
  }
}

TEST(MapCells, FindsColoursOfCells) {
  GridMap map = GridMapBuilder(1, 1).layer("elevation", [](auto, auto) { return 1.0; }).build();
  const auto bytes = std::make_shared<std::vector<std::byte>>(8);
  (*bytes)[4] = std::byte{10};
  (*bytes)[5] = std::byte{20};
  (*bytes)[6] = std::byte{30};
  (*bytes)[7] = std::byte{40};
  map.fields = {{"elevation", 0, FieldType::Float32},
                {"red", 4, FieldType::Uint8},
                {"green", 5, FieldType::Uint8},
                {"blue", 6, FieldType::Uint8},
                {"alpha", 7, FieldType::Uint8}};
  map.cell_stride = map.row_stride = 8;
  map.data = {*bytes, bytes};
  const auto cells = nodes::readMapCells(map);
  ASSERT_TRUE(cells);
  EXPECT_EQ(cells->layers.size(), 1U);
  std::array<std::uint8_t, 4> rgba{};
  nodes::convertCellColors(*cells, rgba);
  EXPECT_THAT(rgba, ElementsAre(10, 20, 30, 40));
}

TEST(MapCells, RefusesSizesThatLie) {
  const GridMap good = GridMapBuilder(3, 2).layer("elevation", [](auto, auto) { return 1.0; }).build();
  EXPECT_EQ(codeOf(good), "Ok");
  const auto changed = [&](auto change) {
    GridMap map = good;
    change(map);
    return codeOf(map);
  };
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
  EXPECT_EQ(changed([](GridMap& m) { m.column_count = kMost; }), "TooManyCells");
  EXPECT_EQ(changed([](GridMap& m) { m.row_count = kMost; }), "TooManyCells");
  EXPECT_EQ(changed([](GridMap& m) { m.row_count = m.column_count = nodes::kMaxMapSide; }), "TooManyCells");
  EXPECT_EQ(changed([](GridMap& m) { m.row_count = 3; }), "MalformedGrid");
  EXPECT_EQ(changed([](GridMap& m) { m.cell_stride = kMost; }), "MalformedGrid");
  EXPECT_EQ(changed([](GridMap& m) { m.row_stride = kMost; }), "MalformedGrid");
  EXPECT_EQ(changed([](GridMap& m) { m.fields[0].offset = kMost; }), "MalformedGrid");
  EXPECT_EQ(changed([](GridMap& m) { m.fields[0].count = kMost; }), "MalformedGrid");
  EXPECT_EQ(changed([](GridMap& m) { m.data.bytes = m.data.bytes.first(23); }), "MalformedGrid");
  EXPECT_EQ(changed([](GridMap& m) { m.fields[0].type = FieldType::Unknown; }), "Ok") << "no layers, but cells";
  EXPECT_EQ(changed([](GridMap& m) { m.cell_stride = m.row_stride = 0; }), "Ok") << "every cell the same bytes";
  for (const double bad : {0.0, -1.0, kNan, kInfinity, 1e300}) {
    EXPECT_EQ(changed([&](GridMap& m) { m.cell_size_m.x = bad; }), "MalformedGrid") << bad;
    EXPECT_EQ(changed([&](GridMap& m) { m.cell_size_m.y = bad; }), "MalformedGrid") << bad;
  }
  EXPECT_EQ(changed([](GridMap& m) { m.origin.translation.z = kNan; }), "MalformedGrid");
  EXPECT_EQ(changed([](GridMap& m) { m.column_count = 0; }), "Ok");
  GridMap short_data = good;
  short_data.data.bytes = short_data.data.bytes.first(23);
  EXPECT_THAT(nodes::readMapCells(short_data).error().message, HasSubstr("needs 24 bytes, it has 23"));
}

TEST(MapSurface, JoinsCentresAndLeavesHoles) {
  const auto full = surfaceOf(GridMapBuilder(4, 3).layer("elevation", [](auto, auto) { return 2.0; }).build());
  EXPECT_EQ(full.triangles.size(), 6U * 3 * 2);
  EXPECT_EQ(full.positions[3], 1.5F);
  EXPECT_EQ(full.positions[1], 0.5F);
  EXPECT_EQ(full.positions[2], 2.0F);
  // One missing corner costs each of its quads a triangle, one missing inside costs four.
  const auto holed = [](std::uint32_t at_column, std::uint32_t at_row) {
    return surfaceOf(GridMapBuilder(4, 3)
                         .layer("elevation", [=](auto c, auto r) { return c == at_column && r == at_row ? kNan : 1.0; })
                         .build());
  };
  EXPECT_EQ(holed(0, 0).triangles.size(), full.triangles.size() - 3);
  EXPECT_EQ(holed(1, 1).triangles.size(), full.triangles.size() - 12);
  for (const std::uint32_t i : holed(1, 1).triangles) {
    EXPECT_NE(i, 5U);
  }
  EXPECT_TRUE(
      surfaceOf(GridMapBuilder(1, 9).layer("elevation", [](auto, auto) { return 1.0; }).build()).triangles.empty());
  EXPECT_TRUE(surfaceOf(GridMapBuilder(9, 9).layer("elevation", [](auto, auto) { return kInfinity; }).build())
                  .triangles.empty());
}

TEST(MapSurface, TurnsEveryTriangleUpAndItsNormalsBySlope) {
  const auto ramp =
      surfaceOf(GridMapBuilder(5, 4).layer("elevation", [](auto column, auto) { return column * 1.0; }).build());
  for (std::size_t i = 0; i < ramp.triangles.size(); i += 3) {
    const auto x = [&](std::size_t k) { return ramp.positions[3 * ramp.triangles[i + k]]; };
    const auto y = [&](std::size_t k) { return ramp.positions[3 * ramp.triangles[i + k] + 1]; };
    EXPECT_GT((x(1) - x(0)) * (y(2) - y(0)) - (x(2) - x(0)) * (y(1) - y(0)), 0.0F);
  }
  for (std::size_t i = 0; i < ramp.normals.size(); i += 4) {
    EXPECT_EQ(ramp.normals[i], -90);
    EXPECT_EQ(ramp.normals[i + 1], 0);
    EXPECT_EQ(ramp.normals[i + 2], 90);
  }
}

TEST(MapSurface, HasNormalsOnAnySlopeAndBesideHoles) {
  // Heights that rise by 2 along x and by 1 along y, with holes: the slopes to one neighbour are those to two.
  const auto normalsOf = [](double size_x, double size_y) {
    GridMap map = GridMapBuilder(7, 6)
                      .layer("elevation",
                             [](auto column, auto row) { return (column + row) % 5 == 1 ? kNan : 2.0 * column + row; })
                      .build();
    map.cell_size_m = {size_x, size_y};
    return surfaceOf(map).normals;
  };
  const auto even = normalsOf(1.0, 1.0);
  int sloping = 0;
  for (std::size_t i = 0; i < even.size() / 4; ++i) {
    const glm::dvec3 normal(even[4 * i], even[4 * i + 1], even[4 * i + 2]);
    EXPECT_NEAR(glm::length(normal), 127.0, 1.0) << i;
    const bool is_whole = normal.x != 0.0 && normal.y != 0.0;
    sloping += is_whole ? 1 : 0;
    if (is_whole) {
      EXPECT_NEAR(normal.x, 127.0 * -2 / std::sqrt(6.0), 1.0) << i;
      EXPECT_NEAR(normal.y, 127.0 * -1 / std::sqrt(6.0), 1.0) << i;
    }
  }
  EXPECT_GT(sloping, 15);
  const auto tiny = normalsOf(1e-300, 1e-300);  // a wall, and no number that is none
  for (std::size_t i = 0; i < tiny.size(); i += 4) {
    EXPECT_NEAR(std::hypot(tiny[i], tiny[i + 1], tiny[i + 2]), 127.0, 1.0);
  }
  EXPECT_EQ(tiny[4 * 3], -90) << "as steep along x as along y";
}

}  // namespace
}  // namespace stillframe::test
