// Objects of recordings that this project did not make, held against answers that it did not compute.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "scenegraph/objects/compressed_point_cloud.h"
#include "scenegraph/objects/grid_map.h"
#include "scenegraph/objects/image.h"
#include "scenegraph/objects/laser_scan.h"
#include "scenegraph/objects/occupancy_grid.h"
#include "scenegraph/objects/point_cloud.h"
#include "scenegraph/objects/poses.h"
#include "scenegraph/objects/robot_description.h"
#include "scenegraph/objects/scene_entities.h"
#include "scenegraph/objects/voxel_grid.h"
#include "tests/tools/ingest/answered.h"

namespace stillframe::ingest {
namespace {

using nlohmann::json;
using scenegraph::ObjectType;
using test::Answered;

glm::dvec3 vectorOf(const json& xyz) { return {xyz["x"], xyz["y"], xyz["z"]}; }

void expectNear(const glm::dvec3& actual, const glm::dvec3& expected, double tolerance) {
  EXPECT_LE(glm::distance(actual, expected), tolerance) << actual.x << ' ' << actual.y << ' ' << actual.z << " is not "
                                                        << expected.x << ' ' << expected.y << ' ' << expected.z;
}

TEST(ConverterData, EverythingDrawableDecodes) {
  std::map<ObjectType, std::size_t> decoded;
  for (const auto& file : std::filesystem::directory_iterator(test::dataFolder() / "mcap_made")) {
    if (file.path().extension() != ".mcap") {
      continue;
    }
    const Answered answered(file.path().stem().string());
    const auto& store = answered.recording->dataset()->store();
    for (const auto& topic : answered.recording->topics()) {
      if (topic.type == ObjectType::None) {
        EXPECT_NE(topic.unsupported_reason, "");
        continue;
      }
      const auto id = *store.findTopic(topic.name);
      for (const auto& entry : store.range(id, std::nullopt, {INT64_MAX})) {
        const auto object = store.decode(id, entry);
        ASSERT_TRUE(object) << file.path() << ' ' << topic.name << ": " << object.error().message;
        EXPECT_EQ(object->type(), topic.type);
        ++decoded[topic.type];
      }
    }
  }
  for (const ObjectType type :
       {ObjectType::Image, ObjectType::PointCloud, ObjectType::FrameTransforms, ObjectType::OccupancyGrid,
        ObjectType::CompressedPointCloud, ObjectType::SceneEntities, ObjectType::RobotDescription,
        ObjectType::CameraInfo, ObjectType::OccupancyGridUpdate, ObjectType::PosesInFrame, ObjectType::VoxelGrid,
        ObjectType::GridMap, ObjectType::LaserScan}) {
    EXPECT_GT(decoded[type], 0u) << toString(type);
  }
}

TEST(ConverterData, LaserScans) {
  std::size_t samples = 0;
  for (const char* name : {"combined_scene_20s", "intel_lab_2d_slam", "turtlebot3_scan_odom"}) {
    samples += Answered(name).eachSample<scenegraph::LaserScan>(
        "sensor_msgs/LaserScan", [](const scenegraph::LaserScan& scan, const json& sample) {
          EXPECT_EQ(json(scan.frame_id), sample["frame_id"]);
          EXPECT_EQ(scan.ranges_m.size(), sample["beams"]);
          std::size_t valid = 0;
          double box[4] = {1e9, 1e9, -1e9, -1e9};
          for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
            const double range = scan.ranges_m[i];
            if (std::isfinite(range) && range >= scan.range_min_m && range <= scan.range_max_m) {
              ++valid;
              const double angle = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
              box[0] = std::min(box[0], range * std::cos(angle));
              box[1] = std::min(box[1], range * std::sin(angle));
              box[2] = std::max(box[2], range * std::cos(angle));
              box[3] = std::max(box[3], range * std::sin(angle));
            }
          }
          EXPECT_EQ(valid, sample["valid"]);
          for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(box[i], sample["bbox_xy_in_scan_frame"][i].get<double>(), 1e-5);
          }
        });
  }
  EXPECT_GE(samples, 9u);
}

TEST(ConverterData, PathsAndPoseArrays) {
  std::size_t samples = 0;
  for (const char* name : {"combined_scene_20s", "intel_lab_2d_slam"}) {
    const Answered answered(name);
    for (const char* schema : {"nav_msgs/Path", "geometry_msgs/PoseArray"}) {
      const bool is_path = std::string_view(schema) == "nav_msgs/Path";
      samples += answered.eachSample<scenegraph::PosesInFrame>(
          schema, [&](const scenegraph::PosesInFrame& poses, const json& sample) {
            EXPECT_EQ(json(poses.frame_id), sample["frame_id"]);
            EXPECT_EQ(poses.kind, is_path ? scenegraph::PosesKind::Path : scenegraph::PosesKind::Array);
            ASSERT_EQ(poses.poses.size(), sample["poses"]);
            EXPECT_EQ(poses.stamps.size(), is_path ? poses.poses.size() : 0u);
            expectNear(poses.poses.front().translation, vectorOf(sample["first"]), 1e-9);
            expectNear(poses.poses.back().translation, vectorOf(sample["last"]), 1e-9);
          });
    }
  }
  EXPECT_GE(samples, 12u);
  const auto odometry = Answered("turtlebot3_scan_odom").at("/odom").get<scenegraph::PosesInFrame>();
  ASSERT_NE(odometry, nullptr);
  EXPECT_EQ(odometry->kind, scenegraph::PosesKind::Single);
  EXPECT_EQ(odometry->child_frame_id, "base_footprint");
  EXPECT_TRUE(odometry->covariance.has_value());
}

TEST(ConverterData, OccupancyGrids) {
  std::size_t samples = 0;
  for (const char* name : {"combined_scene_20s", "intel_lab_2d_slam", "nav2_maps"}) {
    const Answered answered(name);
    samples += answered.eachSample<scenegraph::OccupancyGrid>(
        "nav_msgs/OccupancyGrid", [](const scenegraph::OccupancyGrid& grid, const json& sample) {
          EXPECT_EQ(json(grid.frame_id), sample["frame_id"]);
          EXPECT_EQ(grid.width, sample["width"]);
          EXPECT_EQ(grid.height, sample["height"]);
          EXPECT_EQ(grid.resolution_m, sample["resolution"]);
          EXPECT_EQ(grid.data.bytes.size(), sample["bytes"]);
          expectNear(grid.origin.translation, vectorOf(sample["origin"]["position"]), 0.0);
          EXPECT_EQ(grid.origin.rotation.z, sample["origin"]["orientation"]["z"]);
        });
    for (const auto& [topic, facts] : answered.truth["occupancy"].items()) {
      if (facts["snapshots"].empty() || !answered.truth["topics"].contains(topic)) {
        continue;  // of updates without a base
      }
      const json& first = facts["snapshots"][0];
      const auto grid =
          answered.at(topic, std::stoll(first["log_ns"].get<std::string>())).get<scenegraph::OccupancyGrid>();
      ASSERT_NE(grid, nullptr);
      if (first.contains("unknown") && grid->data.bytes.size() == std::uint64_t{grid->width} * grid->height) {
        EXPECT_EQ(std::ranges::count(grid->data.bytes, std::byte{0xFF}), first["unknown"]) << topic;
      }
    }
  }
  EXPECT_GE(samples, 15u);
  const auto patch = Answered("combined_scene_20s").at("/map_updates").get<scenegraph::OccupancyGridUpdate>();
  ASSERT_NE(patch, nullptr);
  EXPECT_EQ(patch->data.bytes.size(), std::size_t{patch->width} * patch->height);
}

TEST(ConverterData, GridMaps) {
  std::size_t samples = 0;
  for (const char* name : {"combined_scene_20s", "gridmap_ros1"}) {
    samples += Answered(name).eachSample<scenegraph::GridMap>(
        "grid_map_msgs/GridMap", [](const scenegraph::GridMap& map, const json& sample) {
          const json& layers = sample["layers"];
          ASSERT_EQ(map.fields.size(), layers.size());
          EXPECT_NEAR(map.column_count * map.cell_size_m.x, sample["length"][0].get<double>(), 1e-9);
          EXPECT_NEAR(map.row_count * map.cell_size_m.y, sample["length"][1].get<double>(), 1e-9);
          EXPECT_NEAR(map.origin.translation.x, -0.5 * sample["length"][0].get<double>(), 1e-9);
          EXPECT_NEAR(map.origin.translation.y, -0.5 * sample["length"][1].get<double>(), 1e-9);
          for (std::size_t i = 0; i < layers.size(); ++i) {
            EXPECT_EQ(json(map.fields[i].name), layers[i]["name"]);
            std::size_t holes = 0;
            float low = INFINITY;
            float high = -INFINITY;
            for (std::size_t at = map.fields[i].offset; at < map.data.bytes.size(); at += map.cell_stride) {
              float value = 0.0F;
              std::memcpy(&value, map.data.bytes.data() + at, sizeof(value));
              holes += std::isnan(value) ? 1 : 0;
              low = std::fmin(low, value);
              high = std::fmax(high, value);
            }
            EXPECT_EQ(holes, layers[i]["nan"]);
            EXPECT_FLOAT_EQ(low, layers[i]["min"].get<float>());
            EXPECT_FLOAT_EQ(high, layers[i]["max"].get<float>());
          }
        });
  }
  EXPECT_EQ(samples, 3u);
}

TEST(ConverterData, Images) {
  std::size_t samples = 0;
  for (const char* name : {"combined_scene_20s", "realsense_depth_color", "slambook_rgbd"}) {
    const Answered answered(name);
    samples += answered.eachSample<scenegraph::Image>(
        "sensor_msgs/Image", [](const scenegraph::Image& image, const json& sample) {
          EXPECT_EQ(json(image.frame_id), sample["frame_id"]);
          EXPECT_EQ(json(image.encoding), sample["encoding"]);
          EXPECT_EQ(image.width, sample["width"]);
          EXPECT_EQ(image.height, sample["height"]);
          EXPECT_EQ(image.row_step, sample["step"]);
          ASSERT_EQ(image.data.bytes.size(), std::size_t{image.row_step} * image.height);
          if (image.encoding == "16UC1") {
            std::size_t valid = 0;
            for (std::size_t at = 0; at < image.data.bytes.size(); at += 2) {
              valid += image.data.bytes[at] != std::byte{0} || image.data.bytes[at + 1] != std::byte{0} ? 1 : 0;
            }
            EXPECT_EQ(valid, sample["valid_pixels"]);
          }
        });
  }
  EXPECT_GE(samples, 15u);
  const auto info = Answered("slambook_rgbd").at("/rgbd/depth16/camera_info").get<scenegraph::CameraInfo>();
  ASSERT_NE(info, nullptr);
  EXPECT_EQ(info->width, 640u);
  EXPECT_EQ(info->height, 480u);
  EXPECT_GT(info->k[0], 100.0);
  EXPECT_EQ(info->k[8], 1.0);
  EXPECT_EQ(info->p[0], info->k[0]);
}

TEST(ConverterData, VoxelGrids) {
  const Answered answered("combined_scene_20s");
  EXPECT_EQ(answered.eachSample<scenegraph::VoxelGrid>(
                "foxglove_msgs/VoxelGrid",
                [](const scenegraph::VoxelGrid& grid, const json& sample) {
                  EXPECT_EQ(grid.column_count, sample["columns"]);
                  EXPECT_EQ(grid.row_count, sample["rows"]);
                  EXPECT_EQ(grid.slice_count, sample["slices"]);
                  expectNear(grid.cell_size_m, vectorOf(sample["cell_size"]), 0.0);
                  ASSERT_EQ(grid.fields.size(), 1u);
                  EXPECT_EQ(grid.fields[0].name, "occupancy");
                  EXPECT_EQ(grid.fields[0].type, scenegraph::FieldType::Uint8);
                  EXPECT_EQ(std::ranges::count_if(grid.data.bytes, [](std::byte b) { return b != std::byte{0}; }),
                            sample["cells_with_any_nonzero_byte"]);
                }),
            1u);
}

/// Identities alive at a time, without what each looks like: "/topic|<ns length>:<ns>:<id>".
std::set<std::string> aliveMarkers(const Answered& answered, std::int64_t time_ns) {
  std::set<std::string> alive;
  const auto& store = answered.recording->dataset()->store();
  for (const auto& topic : answered.recording->topics()) {
    if (topic.type != ObjectType::SceneEntities) {
      continue;
    }
    std::map<std::string, std::int64_t> until;  // by id
    const auto id = *store.findTopic(topic.name);
    for (const auto& entry : store.range(id, std::nullopt, {time_ns})) {
      const auto scene = store.decode(id, entry)->get<scenegraph::SceneEntities>();
      for (const auto& step : scene->steps) {
        if (!step.is_deletion) {
          const auto& entity = scene->entities[step.index];
          until[entity.id] = entity.lifetime_ns == 0 ? INT64_MAX : entry.log_time.ns + entity.lifetime_ns;
        } else if (scene->deletions[step.index].type == scenegraph::SceneEntityDeletion::Type::All) {
          until.clear();
        } else {
          until.erase(scene->deletions[step.index].id);
        }
      }
    }
    for (const auto& [entity, end] : until) {
      if (end > time_ns) {
        alive.insert(topic.name + "|" + entity);
      }
    }
  }
  return alive;
}

TEST(ConverterData, MarkersAliveAreThoseOfTheReference) {
  std::size_t times = 0;
  for (const char* name : {"combined_scene_20s", "markers_all_types"}) {
    const Answered answered(name);
    for (const json& moment : answered.truth["markers_alive"]) {
      std::set<std::string> expected;
      for (const std::string identity : moment["alive"]) {  // "/objects|breadcrumb|0|type2"
        const std::size_t first = identity.find('|');
        const std::size_t second = identity.find('|', first + 1);
        const std::size_t third = identity.find('|', second + 1);
        const std::string ns = identity.substr(first + 1, second - first - 1);
        expected.insert(identity.substr(0, first + 1) + std::to_string(ns.size()) + ":" + ns + ":" +
                        identity.substr(second + 1, third - second - 1));
      }
      EXPECT_EQ(aliveMarkers(answered, std::stoll(moment["t_ns"].get<std::string>())), expected)
          << name << " at " << moment["t_ns"];
      ++times;
    }
  }
  EXPECT_GE(times, 9u);
}

TEST(ConverterData, BadMarkersAreFaults) {
  const auto scene = Answered("markers_all_types").at("/bad_markers").get<scenegraph::SceneEntities>();
  ASSERT_NE(scene, nullptr);
  using testing::Contains;
  using testing::HasSubstr;
  EXPECT_THAT(scene->faults, Contains(HasSubstr("unknown type 99")));
  EXPECT_THAT(scene->faults, Contains(HasSubstr("'BAD_nan' 0 has a pose or scale that is not finite")));
  EXPECT_THAT(scene->faults, Contains(HasSubstr("odd number")));
  EXPECT_THAT(scene->faults, Contains(HasSubstr("colors for")));
  EXPECT_EQ(scene->faults.size(), 4u) << testing::PrintToString(scene->faults);
}

TEST(ConverterData, FoxgloveProtobuf) {
  const Answered answered("foxglove_protobuf_scene");
  const auto cloud = answered.at("/lidar/points").get<scenegraph::PointCloud>();
  ASSERT_NE(cloud, nullptr);
  EXPECT_GT(cloud->width, 1000u);
  EXPECT_EQ(std::size_t{cloud->width} * cloud->point_step, cloud->data.bytes.size());
  const auto draco = answered.at("/lidar/draco").get<scenegraph::CompressedPointCloud>();
  ASSERT_NE(draco, nullptr);
  EXPECT_EQ(draco->format, "draco");
  EXPECT_GT(draco->data.bytes.size(), 100u);
  const auto voxels = answered.at("/voxels/rgba").get<scenegraph::VoxelGrid>();
  ASSERT_NE(voxels, nullptr);
  EXPECT_EQ(voxels->fields.size(), 4u);
  EXPECT_EQ(std::size_t{voxels->slice_stride} * voxels->slice_count, voxels->data.bytes.size());
  const auto scene = answered.at("/scene").get<scenegraph::SceneEntities>();
  ASSERT_NE(scene, nullptr);
  EXPECT_GT(scene->entities.size(), 0u);
  EXPECT_TRUE(scene->faults.empty()) << testing::PrintToString(scene->faults);
  EXPECT_GT(answered.recording->dataset()->transforms()->frameCount(), 3u);
}

TEST(ConverterData, FoxgloveJson) {
  const Answered answered("mcap_real/lichtblick/custom-camera-model.mcap");
  const auto image = answered.at("/image/compressed").get<scenegraph::Image>();
  ASSERT_NE(image, nullptr);
  EXPECT_THAT(image->encoding, testing::AnyOf("jpeg", "png"));
  EXPECT_GT(image->data.bytes.size(), 100u);
  const auto info = answered.at("/camera_calibration").get<scenegraph::CameraInfo>();
  ASSERT_NE(info, nullptr);
  EXPECT_GT(info->width, 0u);
  EXPECT_GT(info->k[0], 0.0);
}

TEST(ConverterData, Robots) {
  std::size_t robots = 0;
  for (const char* name : {"combined_scene_20s", "urdf_panda", "urdf_r2d2", "urdf_fanuc", "urdf_double_pendulum"}) {
    robots += Answered(name).eachSample<scenegraph::RobotDescription>(
        "std_msgs/String", [](const scenegraph::RobotDescription& robot, const json& sample) {
          EXPECT_EQ(robot.format, "urdf");
          EXPECT_EQ(robot.text.size(), sample["length"]);
        });
  }
  EXPECT_EQ(robots, 5u);
}

}  // namespace
}  // namespace stillframe::ingest
