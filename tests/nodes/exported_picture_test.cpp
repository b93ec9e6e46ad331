#include <algorithm>
#include <cmath>
#include <limits>

#include "nodes/points/codecs/cloudini_header.h"
#include "scenegraph/objects/compressed_point_cloud.h"
#include "scenegraph/objects/laser_scan.h"
#include "tests/nodes/grid_map_builder.h"
#include "tests/nodes/robot_scene.h"
#include "tests/nodes/scene_picture.h"
#include "tests/support/plain_viewer.h"
#include "tools/sample/cloudini_writer.h"

namespace stillframe::test {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr scenegraph::Color kBackground{.r = 0.12F, .g = 0.13F, .b = 0.15F, .a = 1.0F};

struct LayerSetup {
  std::string topic;
  scenegraph::SettingTexts settings;
};

struct ExportCase {
  const char* name;
  std::vector<LayerSetup> layers;
  std::size_t least_drawn;      ///< pixels that are not background
  std::size_t least_drawn_far;  ///< the same at the UTM offset: the grid lies at the fixed frame's origin
  bool is_blended = false;      ///< edges are blended, by us in linear light, by a stock viewer in sRGB bytes
};

std::ostream& operator<<(std::ostream& out, const ExportCase& export_case) { return out << export_case.name; }

/// Pixels that are drawn in one picture and background in the other.
std::size_t drawnInOne(const scenegraph::BytePicture& a, const scenegraph::BytePicture& b,
                       const scenegraph::BytePicture& empty) {
  std::size_t count = 0;
  for (std::size_t i = 0; i + 2 < empty.rgb.size(); i += 3) {
    const auto isDrawn = [&](const scenegraph::BytePicture& picture) {
      return !std::equal(&picture.rgb[i], &picture.rgb[i] + 3, &empty.rgb[i]);
    };
    count += isDrawn(a) != isDrawn(b) ? 1U : 0U;
  }
  return count;
}

/// A bay of 2 m round the sensor.
scenegraph::LaserScan scan() {
  scenegraph::LaserScan scan;
  scan.frame_id = "lidar";
  scan.stamp = {1_s};
  scan.angle_min_rad = -3.0;
  scan.angle_increment_rad = 0.01;
  scan.range_max_m = 10.0;
  for (int i = 0; i < 600; ++i) {
    scan.ranges_m.push_back(1.6 + 0.4 * std::sin(0.05 * i));
    scan.intensities.push_back(i);
  }
  return scan;
}

/// A slope of 40 x 40 points, packed.
scenegraph::CompressedPointCloud packedCloud() {
  nodes::cloudini::Header header;
  header.version = 5;
  header.width = 1600;
  header.point_step = 16;
  header.fields = {{"x", 0, nodes::cloudini::ValueType::Float32, 0.001F},
                   {"y", 4, nodes::cloudini::ValueType::Float32, 0.001F},
                   {"z", 8, nodes::cloudini::ValueType::Float32, 0.001F},
                   {"intensity", 12, nodes::cloudini::ValueType::Float32, {}}};
  std::vector<float> points;
  for (int i = 0; i < 1600; ++i) {
    const auto x = static_cast<float>(i % 40) * 0.08F - 1.6F;
    const auto y = static_cast<float>(i / 40) * 0.08F - 1.6F;
    points.insert(points.end(), {x, y, 0.3F * x, x * y});
  }
  scenegraph::CompressedPointCloud cloud;
  cloud.frame_id = "lidar";
  cloud.format = "cloudini";
  cloud.data = sample::toPayload(sample::writeCloudini(header, std::as_bytes(std::span(points))));
  return cloud;
}

/// Hills over 24 x 24 cells of 20 cm, with a hole.
scenegraph::GridMap hills() {
  scenegraph::GridMap map = GridMapBuilder(24, 24)
                                .origin({.rotation = {1, 0, 0, 0}, .translation = {-2.4, -2.4, -0.5}})
                                .layer("elevation",
                                       [](auto column, auto row) {
                                         return column == 5 && row == 18
                                                    ? std::numeric_limits<double>::quiet_NaN()
                                                    : 0.3 * std::sin(0.5 * column) * std::cos(0.4 * row);
                                       })
                                .layer("cost", [](auto column, auto row) { return static_cast<double>(column + row); })
                                .build();
  map.cell_size_m = {0.2, 0.2};
  return map;
}

class ExportedPicture : public ScenePictureTest, public testing::WithParamInterface<ExportCase> {};

TEST_P(ExportedPicture, IsTheSameInAPlainViewer) {
  const std::array<glm::dvec3, 2> places{glm::dvec3(0.0), glm::dvec3(5e5, 5e6, 120.0)};
  for (const glm::dvec3& place : places) {
    const bool is_far = place.x > 0.0;
    SCOPED_TRACE(is_far ? "at a UTM offset" : "at the origin");
    DatasetBuilder robot = robotBuilderAt(place);
    robot.topic("/scan", scenegraph::ObjectType::LaserScan).at(1_s, scan());
    robot.topic("/packed", scenegraph::ObjectType::CompressedPointCloud).at(1_s, packedCloud());
    robot.topic("/hills", scenegraph::ObjectType::GridMap).at(1_s, hills());
    open(robot.build(), "utm");
    for (const LayerSetup& layer : GetParam().layers) {
      add(layer.topic, layer.settings);
    }
    scene_->update(tf::TimePoint{1_s});
    const scenegraph::CameraView view{.eye_from_fixed =
                                          scenegraph::lookAt(place + glm::dvec3(3.5, -5.0, 4.0), place, {0, 0, 1})};
    const auto ours = scenegraph::toBytes(
        render(scene_->root(), view, {.width = kWidth, .height = kHeight, .background = kBackground}));
    const osg::ref_ptr<osg::Group> nothing = new osg::Group;
    const auto empty = drawPlainly(*nothing, view, 0.1, 100.0, kWidth, kHeight, kBackground);
    const std::size_t drawn = difference(ours, empty).pixels;
    EXPECT_GE(drawn, is_far ? GetParam().least_drawn_far : GetParam().least_drawn);
    for (const char* const extension : kExportExtensions) {
      const osg::ref_ptr<osg::Node> back = exportedAndRead(scene_->root(), extension, kHeight);
      ASSERT_TRUE(back.valid());
      const auto plain = drawPlainly(*back, view, 0.1, 100.0, kWidth, kHeight, kBackground);
      const auto differs = difference(ours, plain);
      const std::string key = std::string(extension) + (is_far ? "_utm" : "_origin");
      RecordProperty("pixels_" + key, static_cast<int>(differs.pixels));
      RecordProperty("largest_" + key, differs.largest);
      EXPECT_LE(drawnInOne(ours, plain, empty), GetParam().is_blended ? drawn / 50 : 0U) << extension;
      if (!GetParam().is_blended) {
        // One step of a channel where a colour between two bytes is rounded to half float on its way through linear
        // light, nothing else.
        EXPECT_EQ(differs.beyond_one, 0U) << extension << ": largest " << differs.largest;
        EXPECT_LE(differs.pixels * 6, drawn) << extension;
      }
    }
  }
}

const LayerSetup kGrid{"grid", {}};
const LayerSetup kAxes{"tf", {{"axis_length", "0.6"}, {"hidden_frames", "utm"}}};

LayerSetup cloud(scenegraph::SettingTexts settings) { return {"/points", std::move(settings)}; }

INSTANTIATE_TEST_SUITE_P(
    Layers, ExportedPicture,
    testing::Values(
        ExportCase{"cloud_by_z", {cloud({{"color_field", "z"}, {"point_size", "3"}})}, 5000, 5000},
        ExportCase{"cloud_by_intensity", {cloud({{"color_field", "intensity"}})}, 3000, 3000},
        ExportCase{
            "cloud_rgb", {cloud({{"color_field", "rgb"}, {"round_points", "true"}, {"point_size", "5"}})}, 5000, 5000},
        ExportCase{"cloud_in_metres",
                   {cloud({{"color_field", "flat"}, {"size_unit", "m"}, {"point_size", "0.05"}})},
                   5000,
                   5000},
        ExportCase{"scan", {{"/scan", {{"point_size", "4"}}}}, 2000, 2000},
        ExportCase{"compressed_cloud", {{"/packed", {{"color_field", "intensity"}, {"point_size", "3"}}}}, 4000, 4000},
        ExportCase{"grid_map", {{"/hills", {}}}, 8000, 8000},
        ExportCase{"grid_map_by_cost", {{"/hills", {{"color_field", "cost"}, {"shading", "false"}}}}, 8000, 8000},
        ExportCase{"poses",
                   {{"/pose_array", {{"length", "0.7"}}},
                    {"/path", {{"color_field", "time"}, {"line_width", "4"}}},
                    {"/footprint", {{"line_unit", "m"}, {"line_width", "0.1"}}}},
                   1500,
                   1500},
        ExportCase{"covariance",
                   {{"/odometry", {{"shape", "arrows"}, {"length", "1"}}}, {"/footprint", {{"fill", "true"}}}},
                   1000,
                   1000,
                   true},
        ExportCase{"axes", {kAxes}, 300, 300}, ExportCase{"grid", {kGrid}, 500, 0},
        ExportCase{
            "labels", {{"tf", {{"labels", "true"}, {"axes", "false"}, {"hidden_frames", "utm"}}}}, 300, 300, true},
        ExportCase{"all", {kGrid, kAxes, cloud({{"color_field", "z"}})}, 5000, 5000}),
    [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace stillframe::test
