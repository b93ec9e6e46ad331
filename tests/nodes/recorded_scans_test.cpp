#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nodes/grid_map/map_cells.h"
#include "nodes/laser_scan/scan_cloud.h"
#include "scenegraph/objects/grid_map.h"
#include "scenegraph/objects/laser_scan.h"
#include "tests/support/recordings.h"
#include "tools/ingest/recording.h"

namespace stillframe::test {
namespace {

using nlohmann::json;

/// Calls `check(object, sample)` for every reference answer of that ROS type in the recording.
template <typename T, typename Check>
void forEachSample(const std::string& name, const char* ros_type, const Check& check) {
  const json truth = json::parse(std::ifstream(kData / "truth" / (name + ".json")));
  const std::vector<std::filesystem::path> files = {kData / "mcap_made" / (name + ".mcap")};
  const auto recording = ingest::Recording::open(files);
  ASSERT_TRUE(recording) << recording.error().message;
  (*recording)->load();
  const scenegraph::ObjectStore& store = (*recording)->dataset()->store();
  for (const auto& [topic, about] : truth["topics"].items()) {
    if (about["type"] != ros_type) {
      continue;
    }
    for (const json& sample : about["samples"]) {
      SCOPED_TRACE(name + " " + topic + " " + sample["log_ns"].get<std::string>());
      const auto id = store.findTopic(topic, T::kType);
      ASSERT_TRUE(id);
      const auto entry = store.newestAtOrBefore(*id, tf::TimePoint{std::stoll(sample["log_ns"].get<std::string>())});
      ASSERT_TRUE(entry);
      const auto object = store.decode(*id, *entry);
      ASSERT_TRUE(object) << object.error().message;
      check(*object->template get<T>(), sample);
    }
  }
}

TEST(RecordedScans, HaveTheReturnsAndBoxesOfTheReferenceAnswers) {
  std::size_t compared = 0;
  for (const char* name : {"combined_scene_20s", "turtlebot3_scan_odom", "intel_lab_2d_slam"}) {
    forEachSample<scenegraph::LaserScan>(
        name, "sensor_msgs/LaserScan", [&](const scenegraph::LaserScan& scan, const json& sample) {
          EXPECT_EQ(scan.frame_id, sample["frame_id"].get<std::string>());
          EXPECT_EQ(scan.ranges_m.size(), sample["beams"].get<std::size_t>());
          const auto converted = nodes::convertScan(scan);
          ASSERT_TRUE(converted) << converted.error().message;
          EXPECT_EQ(converted->cloud.width, sample["valid"].get<std::size_t>());
          constexpr double kInfinity = std::numeric_limits<double>::infinity();
          std::array<double, 4> box{kInfinity, kInfinity, -kInfinity, -kInfinity};
          for (std::size_t i = 0; i < converted->cloud.width; ++i) {
            float xy[2];
            std::memcpy(xy, converted->cloud.data.bytes.data() + i * converted->cloud.point_step, sizeof xy);
            for (std::size_t axis = 0; axis < 2; ++axis) {
              box[axis] = std::min<double>(box[axis], xy[axis]);
              box[axis + 2] = std::max<double>(box[axis + 2], xy[axis]);
            }
          }
          for (std::size_t i = 0; i < 4; ++i) {
            // The angles are FLOAT32 in the message: at 20 m they are worth some micrometres.
            EXPECT_NEAR(box[i], sample["bbox_xy_in_scan_frame"][i].get<double>(), 1e-5);
          }
          ++compared;
        });
  }
  EXPECT_EQ(compared, 9U);
}

TEST(RecordedGridMaps, HaveTheCellsAndLimitsOfTheReferenceAnswers) {
  std::size_t compared = 0;
  forEachSample<scenegraph::GridMap>(
      "gridmap_ros1", "grid_map_msgs/GridMap", [&](const scenegraph::GridMap& map, const json& sample) {
        EXPECT_NEAR(map.cell_size_m.x, sample["resolution"].get<double>(), 1e-12);
        EXPECT_NEAR(map.cell_size_m.x * map.column_count, sample["length"][0].get<double>(), 1e-9);
        EXPECT_NEAR(map.cell_size_m.y * map.row_count, sample["length"][1].get<double>(), 1e-9);
        const auto cells = nodes::readMapCells(map);
        ASSERT_TRUE(cells) << cells.error().message;
        for (const json& layer : sample["layers"]) {
          const auto info =
              std::ranges::find(cells->layers, layer["name"].get<std::string>(), &nodes::ChannelInfo::name);
          ASSERT_NE(info, cells->layers.end());
          std::vector<float> values(cells->all.points);
          const auto limits = nodes::convertChannel(cells->records, cells->all, *info, values);
          EXPECT_EQ(values.size(), layer["values"].get<std::size_t>());
          EXPECT_EQ(values.size() - limits.finite, layer["nan"].get<std::size_t>());
          EXPECT_NEAR(limits.low, layer["min"].get<double>(), 1e-7);
          EXPECT_NEAR(limits.high, layer["max"].get<double>(), 1e-7);
          ++compared;
        }
      });
  EXPECT_EQ(compared, 1U);
}

}  // namespace
}  // namespace stillframe::test
