// What each layer of sensor data says of what is picked in it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/nodes/grid_map_builder.h"
#include "tests/nodes/images/image_builder.h"
#include "tests/nodes/occupancy_grid/grid_builder.h"
#include "tests/nodes/pick/pick_picture.h"
#include "tests/nodes/voxel_grid/voxel_builder.h"

namespace stillframe::test {
namespace {

using scenegraph::FieldType;
using scenegraph::ObjectType;
using scenegraph::PickError;

using PickedLayers = PickTest;

DatasetBuilder lidarAt(const tf::RigidTransform& map_from_lidar) {
  DatasetBuilder builder;
  builder.topic("/tf", ObjectType::FrameTransforms).transform(0, "map", "lidar", map_from_lidar);
  return builder;
}

TEST_F(PickedLayers, PointSaysEveryFieldInItsOwnTypeAndKeepsItsNumberInTheMessage) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  scenegraph::PointCloud cloud = CloudBuilder("lidar")
                                     .field("t", FieldType::Float64)
                                     .field("x", FieldType::Float32)
                                     .field("y", FieldType::Float32)
                                     .field("z", FieldType::Float32)
                                     .field("ring", FieldType::Int16)
                                     .field("rgb", FieldType::Uint32)
                                     .field("big", FieldType::Uint32)
                                     .point({0.125, 3, 3, 3, 1, 0x112233, 5})
                                     .point({0.25, kNan, 0, 0, 2, 0, 0})
                                     .point({1.0e9 + 0.1, 0, 0.1F, 0, -7, 0xff8040, 4294967295.0})
                                     .build();
  cloud.color_packing = scenegraph::ColorPacking::PclWord;
  open(lidarAt(turn(1.0, 2e6, 1e6, 5.0)).topic("/points", ObjectType::PointCloud).at(1_s, cloud).build(), "lidar");
  add("/points");
  draw(1_s, fromAbove());
  const auto result = pickAt(100, 99);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->picked.id, "2") << "the point that is not finite counts";
  EXPECT_EQ(field(result->picked, "t"), "1000000000.1");
  EXPECT_EQ(field(result->picked, "y"), "0.1") << "a float's own digits";
  EXPECT_EQ(field(result->picked, "ring"), "-7");
  EXPECT_EQ(field(result->picked, "big"), "4294967295");
  EXPECT_EQ(field(result->picked, "color"), "#ff8040");
  expectPoint(result->picked.point_in_frame, {0.0, static_cast<double>(0.1F), 0.0}, 0.0);
  expectPoint(*scenegraph::pointIn(*scene_, *result, "map"),
              tf::transformPoint(turn(1.0, 2e6, 1e6, 5.0), {0.0, static_cast<double>(0.1F), 0.0}));
  EXPECT_FALSE(scenegraph::pointIn(*scene_, *result, "nowhere"));
}

TEST_F(PickedLayers, PointFarFromItsFramesOriginIsThatOfTheMessageInDouble) {
  CloudBuilder builder("lidar");
  builder.field("x", FieldType::Float64).field("y", FieldType::Float64).field("z", FieldType::Float64);
  builder.point({4567890.123456, 123456.7654321, 10.0}).point({4567891.123456, 123457.7654321, 10.0});
  scenegraph::PointCloud cloud = builder.build();
  cloud.pose = turn(0.0, 1.0, 0.0, 0.0);
  open(lidarAt({}).topic("/points", ObjectType::PointCloud).at(1_s, cloud).build(), "map");
  add("/points");
  draw(1_s, fromAbove(4567891.123456, 123456.7654321, 20.0));
  const auto result = pickAt(100, 100);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->picked.id, "0");
  EXPECT_EQ(result->point_in_fixed, glm::dvec3(4567891.123456, 123456.7654321, 10.0));
}

TEST_F(PickedLayers, CellOfAnOccupancyGridSaysItsValueEvenWhereItIsSeenAtAnAngle) {
  scenegraph::OccupancyGrid grid = makeGrid(4, {0, 10, 20, 30, -1, 50, 65, 100, 80, 90, 101, 5}, "lidar", 0.5);
  grid.stamp = tf::TimePoint{42};
  grid.origin = turn(0.5, -1.0, -0.5, 0.25);
  const tf::RigidTransform map_from_lidar = turn(-0.3, 4e6, 1e6, 100.0);
  open(lidarAt(map_from_lidar).topic("/map", ObjectType::OccupancyGrid).at(1_s, grid).build(), "map");
  add("/map");
  const tf::RigidTransform map_from_grid = map_from_lidar * grid.origin;
  const glm::dvec3 middle = tf::transformPoint(map_from_grid, {1.0, 0.75, 0.0});
  const scenegraph::CameraView view{.eye_from_fixed =
                                        scenegraph::lookAt(middle + glm::dvec3(2.0, -1.5, 1.5), middle, {0, 0, 1})};
  draw(1_s, view);
  int seen = 0;
  for (std::uint32_t row = 0; row < 3; ++row) {
    for (std::uint32_t column = 0; column < 4; ++column) {
      const glm::dvec3 centre = tf::transformPoint(map_from_grid, {0.5 * column + 0.25, 0.5 * row + 0.25, 0.0});
      const auto at = scenegraph::toScreen(view, {200, 200}, centre);
      if (!at || at->position_px.x < 0 || at->position_px.x >= 200 || at->position_px.y < 0 ||
          at->position_px.y >= 200) {
        continue;
      }
      const auto result = pickAt(static_cast<int>(at->position_px.x), static_cast<int>(at->position_px.y));
      ASSERT_TRUE(result);
      EXPECT_EQ(result->picked.id, std::to_string(column) + "," + std::to_string(row));
      EXPECT_EQ(field(result->picked, "value"),
                std::to_string(static_cast<std::int8_t>(grid.data.bytes[4 * row + column])));
      EXPECT_EQ(result->picked.stamp, tf::TimePoint{42});
      expectPoint(result->point_in_fixed, centre, 1e-8);
      ++seen;
    }
  }
  EXPECT_GE(seen, 8);
}

TEST_F(PickedLayers, VoxelSaysItsPlaceAndEveryFieldThoughOnlySomeAreDrawn) {
  const auto cost = [](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return (x + y + z) % 2 == 0 ? 0.0 : 10.0 * z + x + 3.0 * y;
  };
  const scenegraph::VoxelGrid grid =
      VoxelBuilder(5, 4, 3, 2)
          .frame("lidar")
          .cell({1.0, 2.0, 0.5})
          .field("cost", FieldType::Uint8, cost)
          .field("height", FieldType::Float32, [](auto, auto, auto z) { return 0.1 * z; })
          .build();
  open(lidarAt(turn(0.0, -2.5, -4.0, 0.0)).topic("/voxels", ObjectType::VoxelGrid).at(1_s, grid).build(), "map");
  add("/voxels");
  draw(1_s, fromAbove());
  int seen = 0;
  for (std::uint32_t y = 0; y < 4; ++y) {
    for (std::uint32_t x = 0; x < 5; ++x) {
      // From above the highest one that is drawn.
      const std::uint32_t z = cost(x, y, 2) > 0.0 ? 2 : 1;
      const glm::dvec3 centre(x + 0.5 - 2.5, 2.0 * y + 1.0 - 4.0, 0.5 * z + 0.25);
      const auto result = pickAt(static_cast<int>(100 + 10 * centre.x), static_cast<int>(100 - 10 * centre.y));
      ASSERT_TRUE(result) << x << " " << y;
      EXPECT_EQ(result->picked.kind, "voxel");
      EXPECT_EQ(result->picked.id, std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(z));
      EXPECT_EQ(field(result->picked, "cost"), std::to_string(static_cast<int>(cost(x, y, z))));
      EXPECT_EQ(field(result->picked, "height"), scenegraph::pickText(0.1F * static_cast<float>(z)));
      expectPoint(result->point_in_fixed, centre);
      ++seen;
    }
  }
  EXPECT_EQ(seen, 20);
}

TEST_F(PickedLayers, CellOfAGridMapSaysAllItsLayersAndItsOwnHeight) {
  const auto height = [](std::uint32_t column, std::uint32_t row) { return 0.5 * column - 0.25 * row; };
  const scenegraph::GridMap map = GridMapBuilder(8, 6, 3)
                                      .frame("lidar")
                                      .origin(turn(0.0, -4.0, -3.0, 1.0))
                                      .layer("elevation", height)
                                      .layer("slope", [](auto column, auto row) { return column * 100.0 + row; })
                                      .build();
  open(lidarAt({}).topic("/map", ObjectType::GridMap).at(1_s, map).build(), "map");
  auto& layer = add("/map");
  for (const char* const flat : {"false", "true"}) {
    ASSERT_TRUE(layer.applySettings({{"flat", flat}}));
    draw(1_s, fromAbove());
    for (std::uint32_t row = 1; row < 5; ++row) {
      for (std::uint32_t column = 1; column < 7; ++column) {
        const glm::dvec3 centre(column + 0.5 - 4.0, row + 0.5 - 3.0,
                                1.0 + (std::string(flat) == "true" ? 0.0 : height(column, row)));
        const auto result = pickAt(static_cast<int>(100 + 10 * centre.x), static_cast<int>(100 - 10 * centre.y));
        ASSERT_TRUE(result);
        EXPECT_EQ(result->picked.id, std::to_string(column) + "," + std::to_string(row));
        EXPECT_EQ(field(result->picked, "slope"), std::to_string(100 * column + row));
        expectPoint(result->point_in_fixed, centre);
      }
    }
  }
}

TEST_F(PickedLayers, PixelOfADepthImageSaysItsPlaceInTheImage) {
  DatasetBuilder builder;
  builder.topic("/tf", ObjectType::FrameTransforms).transform(0, "map", "optical", turn(0.0, 10.0, 20.0, 30.0));
  builder.topic("/depth/camera_info", ObjectType::CameraInfo).at(1_s, cameraInfo("optical", 3, 2, 1.0));
  builder.topic("/depth/image_raw", ObjectType::Image)
      .at(1_s, depthImage16("optical", 3, {2000, 0, 6000, 1000, 3000, 5000}));
  open(builder.build(), "map");
  add("/depth/image_raw");
  const scenegraph::CameraView view{.eye_from_fixed = scenegraph::lookAt({10, 20, 30}, {10, 20, 31}, {0, -1, 0}),
                                    .is_orthographic = true,
                                    .vertical_extent_m = 20.0};
  draw(1_s, view);
  const auto result = pickAt(160 + 3, 100 - 30 - 2);  // ray (1, -0.5), 6 m
  ASSERT_TRUE(result);
  EXPECT_EQ(result->picked.kind, "pixel");
  EXPECT_EQ(result->picked.id, "2,0");
  EXPECT_EQ(field(result->picked, "depth_m"), "6");
  EXPECT_EQ(result->picked.point_in_frame, glm::dvec3(6.0, -3.0, 6.0));
  expectPoint(result->point_in_fixed, {16.0, 17.0, 36.0});
  EXPECT_EQ(pickAt(20, 190).error(), PickError::NothingThere);
}

}  // namespace
}  // namespace stillframe::test
