#include <array>
#include <cmath>
#include <limits>

#include "nodes/registry.h"
#include "scenegraph/objects/compressed_point_cloud.h"
#include "scenegraph/objects/laser_scan.h"
#include "scenegraph/objects/poses.h"
#include "scenegraph/objects/robot_description.h"
#include "scenegraph/objects/scene_entities.h"
#include "tests/nodes/grid_map_builder.h"
#include "tests/nodes/images/image_builder.h"
#include "tests/nodes/occupancy_grid/grid_builder.h"
#include "tests/nodes/voxel_grid/voxel_builder.h"
#include "tests/support/layer_contract.h"
#include "tools/sample/cloudini_writer.h"

namespace stillframe::test {
namespace {

using scenegraph::FieldType;

void addCloud(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame, unsigned seed) {
  Random random(seed);
  CloudBuilder cloud(frame);
  cloud.xyz().field("intensity", FieldType::Float32);
  for (unsigned i = 0; i < 5 + seed % 3; ++i) {
    cloud.point({random.number(-5, 5), random.number(-5, 5), random.number(-5, 5), random.number(0, 100)});
  }
  builder.at(log_ns, cloud.build());
}

void addEmptyCloud(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame) {
  builder.at(log_ns, CloudBuilder(frame).xyz().build());
}

/// 0.1 s or more from the log time on.
scenegraph::LaserScan scanAt(std::int64_t log_ns, const std::string& frame, std::size_t beams) {
  scenegraph::LaserScan scan;
  scan.stamp = {log_ns};
  scan.frame_id = frame;
  scan.angle_increment_rad = 0.1;
  scan.time_increment_s = 0.01;
  scan.range_max_m = 10.0;
  scan.ranges_m.resize(beams);
  return scan;
}

void addScan(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame, unsigned seed) {
  Random random(seed);
  auto scan = scanAt(log_ns, frame, 10 + seed % 3);
  for (double& range : scan.ranges_m) {
    range = random.number(1.0, 12.0);
  }
  scan.ranges_m.front() = 2.0;
  scan.intensities = scan.ranges_m;
  builder.at(log_ns, std::move(scan));
}

void addEmptyScan(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame) {
  builder.at(log_ns, scanAt(log_ns, frame, 0));
}

void addGrid(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame, unsigned seed) {
  Random random(seed);
  std::vector<std::int8_t> cells(300 * (4 + seed % 3));
  for (std::int8_t& cell : cells) {
    cell = static_cast<std::int8_t>(static_cast<int>(random.index(256)) - 128);
  }
  scenegraph::OccupancyGrid grid = makeGrid(300, cells, frame, 0.05);
  grid.origin = turn(0.1 * seed, 1, 2, 3);
  builder.topic("/data", scenegraph::ObjectType::OccupancyGrid).at(log_ns, grid);
  // Updates after it, before the next.
  builder.topic("/data_updates", scenegraph::ObjectType::OccupancyGridUpdate);
  for (const std::int64_t delay : {100_ms, 400_ms, 700_ms}) {
    builder.at(log_ns + delay, makePatch(static_cast<std::int32_t>(random.index(310)) - 5, 1, 2, {9, 8, 7, 6}, frame));
  }
  builder.topic("/data", scenegraph::ObjectType::OccupancyGrid);
}

void addEmptyGrid(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame) {
  builder.at(log_ns, makeGrid(0, {}, frame));
}

/// Floats x, y, z, intensity as a Cloudini blob.
void addCompressed(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame,
                   const std::vector<float>& values) {
  using nodes::cloudini::ValueType;
  nodes::cloudini::Header header;
  header.version = 5;
  header.width = static_cast<std::uint32_t>(values.size() / 4);
  header.point_step = 16;
  header.fields = {{"x", 0, ValueType::Float32, 0.001F},
                   {"y", 4, ValueType::Float32, 0.001F},
                   {"z", 8, ValueType::Float32, 0.001F},
                   {"intensity", 12, ValueType::Float32, {}}};
  scenegraph::CompressedPointCloud cloud;
  cloud.frame_id = frame;
  cloud.format = "cloudini";
  cloud.data = sample::toPayload(sample::writeCloudini(header, std::as_bytes(std::span(values))));
  builder.at(log_ns, std::move(cloud));
}

void addCompressedCloud(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame, unsigned seed) {
  Random random(seed);
  std::vector<float> values(4 * (5 + seed % 3));
  for (float& value : values) {
    value = static_cast<float>(random.number(-5, 5));
  }
  addCompressed(builder, log_ns, frame, values);
}

void addEmptyCompressedCloud(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame) {
  addCompressed(builder, log_ns, frame, {});
}

void addMap(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame, unsigned seed) {
  Random random(seed);
  GridMapBuilder map(4, 3 + seed % 2);
  map.frame(frame).layer("elevation", [&](auto, auto) { return random.number(-1, 1); });
  map.layer("cost", [&](auto column, auto) { return column == 1 ? std::nan("") : random.number(0, 9); });
  builder.at(log_ns, map.build());
}

void addEmptyMap(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame) {
  builder.at(log_ns, GridMapBuilder(0, 0).frame(frame).layer("elevation", [](auto, auto) { return 0.0; }).build());
}

void addDepthImage(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame, unsigned seed) {
  builder.topic("/data/camera_info", scenegraph::ObjectType::CameraInfo).at(log_ns, cameraInfo(frame, 4, 3));
  Random random(seed);
  std::vector<std::uint16_t> millimetres(12);
  for (std::uint16_t& depth : millimetres) {
    depth = static_cast<std::uint16_t>(random.number(0, 5000));
  }
  millimetres[seed % 12] = 0;
  builder.topic("/data", scenegraph::ObjectType::Image).at(log_ns, depthImage16(frame, 4, millimetres));
}

void addEmptyDepthImage(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame) {
  builder.at(log_ns, depthImage16(frame, 4, std::vector<std::uint16_t>(12, 0)));
}

/// A box on the root link `frame`, and a wheel on a joint that nothing tells of.
void addRobot(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame, unsigned seed) {
  const std::string size = std::to_string(1 + seed % 5);
  builder.at(log_ns,
             scenegraph::RobotDescription{
                 .format = "urdf",
                 .text = "<robot name='r'><link name='" + frame + "'><visual><geometry><box size='" + size +
                         " 1 1'/></geometry></visual></link><link name='wheel'><visual><geometry><cylinder radius='0." +
                         size + "' length='1'/></geometry></visual></link><joint name='axle' type='continuous'>" +
                         "<parent link='" + frame + "'/><child link='wheel'/><origin xyz='1 2 3'/></joint></robot>"});
}

void addEmptyRobot(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame) {
  builder.at(log_ns, scenegraph::RobotDescription{.format = "urdf",
                                                  .text = "<robot name='r'><link name='" + frame + "'/></robot>"});
}

void addVoxels(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame, unsigned seed) {
  Random random(seed);
  VoxelBuilder grid(4 + seed % 3, 3, 5, seed % 2);
  grid.frame(frame).origin(random.transform(5.0));
  grid.field("cost", seed % 2 == 0 ? FieldType::Uint8 : FieldType::Float32,
             [&](auto, auto, auto) { return random.number(0, 100); });
  builder.at(log_ns, grid.build());
}

void addEmptyVoxels(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame) {
  builder.at(log_ns, VoxelBuilder(0, 3, 5).frame(frame).build());
}

/// By seed: an array, a path, a pose with covariance, a point, a polygon.
void addPoses(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame, unsigned seed) {
  using scenegraph::PosesKind;
  Random random(seed);
  scenegraph::PosesInFrame poses;
  poses.frame_id = frame;
  poses.kind =
      std::array{PosesKind::Array, PosesKind::Path, PosesKind::Single, PosesKind::Point, PosesKind::Polygon}[seed % 5];
  const bool is_one = poses.kind == PosesKind::Single || poses.kind == PosesKind::Point;
  for (unsigned i = 0; i < (is_one ? 1 : 3 + seed % 4); ++i) {
    poses.poses.push_back(random.transform(5));
    poses.stamps.push_back({log_ns + i});
  }
  if (poses.kind == PosesKind::Single) {
    poses.covariance.emplace();
    for (std::size_t i = 0; i < 36; i += 7) {
      (*poses.covariance)[i] = random.number(0.01, 0.2);
    }
  }
  builder.at(log_ns, std::move(poses));
}

void addEmptyPoses(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame) {
  scenegraph::PosesInFrame poses;
  poses.frame_id = frame;
  builder.at(log_ns, std::move(poses));
}

/// One entity of every kind of primitive, replaced by the next message; another that ends with its lifetime; and some
/// of few ids that come and go.
void addMarkers(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame, unsigned seed) {
  Random random(seed);
  const auto pose = [&] {
    return tf::RigidTransform{.rotation = {1, 0, 0, 0},
                              .translation = {random.number(-5, 5), random.number(-5, 5), random.number(0, 2)}};
  };
  scenegraph::SceneEntities scene;
  const auto add = [&](scenegraph::SceneEntity entity) {
    entity.frame_id = frame;
    entity.is_frame_locked = true;
    scene.steps.push_back({false, scene.entities.size()});
    scene.entities.push_back(std::move(entity));
  };
  scene.deletions.push_back({.type = scenegraph::SceneEntityDeletion::Type::All,
                             .stamp = {std::numeric_limits<std::int64_t>::max()},
                             .id = "",
                             .marker_namespace = "few"});
  scene.steps.push_back({true, 0});
  scenegraph::SceneEntity all;
  all.id = "all";
  all.marker_namespace = "kinds";
  all.arrows.push_back({.pose = pose(),
                        .shaft_length = 1,
                        .shaft_diameter = 0.1,
                        .head_length = 0.3,
                        .head_diameter = 0.2,
                        .color = {1, 0, 0, seed % 2 == 0 ? 1.0F : 0.5F}});
  all.cylinders.push_back({.pose = pose(), .size = {1, 1, 2}, .bottom_scale = 1, .top_scale = 0.5, .color = {}});
  all.points.push_back(
      {.pose = pose(), .width_m = 0.1, .height_m = 0.1, .points = {{0, 0, 0}, {1, 1, 1}}, .color = {}, .colors = {}});
  all.lines.push_back({.type = scenegraph::LineType::Strip,
                       .pose = pose(),
                       .thickness = 0.1,
                       .points = {{0, 0, 0}, {1, 0, 0}, {1, random.number(0, 1), 0}},
                       .color = {},
                       .colors = {},
                       .indices = {}});
  all.triangles.push_back({.pose = pose(),
                           .points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                           .color = {0, 1, 0, 0.5F},
                           .colors = {},
                           .indices = {}});
  all.texts.push_back(
      {.pose = pose(), .is_billboard = true, .font_size = 0.5, .color = {}, .text = "gr\u00fc\u00df\ndich"});
  all.axes.push_back({.pose = pose(), .length = 1, .thickness = 0.1});
  add(all);
  scenegraph::SceneEntity brief;
  brief.id = "brief";
  brief.lifetime_ns = 400_ms;
  brief.spheres.push_back({.pose = pose(), .size = {1, 2, 3}, .color = {}});
  add(brief);
  for (unsigned i = 0; i < seed % 5; ++i) {
    scenegraph::SceneEntity entity;
    entity.id = "few" + std::to_string(random.index(8));
    entity.marker_namespace = "few";
    entity.cubes.resize(1 + random.index(3), {.pose = pose(), .size = {1, 1, 1}, .color = {}});
    add(entity);
  }
  builder.at(log_ns, std::move(scene));
}

void addNoMarkers(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame) {
  scenegraph::SceneEntities scene;
  for (const char* const id : {"all", "brief"}) {
    scenegraph::SceneEntity entity;
    entity.id = id;
    entity.frame_id = frame;
    scene.steps.push_back({false, scene.entities.size()});
    scene.entities.push_back(std::move(entity));
  }
  scene.deletions.push_back({.type = scenegraph::SceneEntityDeletion::Type::All,
                             .stamp = {std::numeric_limits<std::int64_t>::max()},
                             .id = "",
                             .marker_namespace = "few"});
  scene.steps.push_back({true, 0});
  builder.at(log_ns, std::move(scene));
}

}  // namespace

std::vector<LayerCase> layerCases() {
  return {{.type = "grid"},
          {.type = "tf"},
          {.type = "point_cloud", .add = addCloud, .addEmpty = addEmptyCloud},
          {.type = "laser_scan", .add = addScan, .addEmpty = addEmptyScan},
          {.type = "occupancy_grid", .add = addGrid, .addEmpty = addEmptyGrid},
          {.type = "compressed_cloud", .add = addCompressedCloud, .addEmpty = addEmptyCompressedCloud},
          {.type = "grid_map", .add = addMap, .addEmpty = addEmptyMap},
          {.type = "poses", .add = addPoses, .addEmpty = addEmptyPoses},
          {.type = "depth_image", .add = addDepthImage, .addEmpty = addEmptyDepthImage},
          {.type = "robot_model", .add = addRobot, .addEmpty = addEmptyRobot},
          {.type = "voxel_grid", .add = addVoxels, .addEmpty = addEmptyVoxels},
          {.type = "markers", .add = addMarkers, .addEmpty = addNoMarkers}};
}

std::span<const scenegraph::LayerType> typesUnderTest() { return nodes::layerTypes(); }

}  // namespace stillframe::test
