#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nodes/points/channel.h"
#include "nodes/points/point_colors.h"
#include "tests/nodes/cloud_builder.h"
#include "tests/support/recordings.h"
#include "tools/ingest/recording.h"

namespace stillframe::test {
namespace {

using nlohmann::json;

/// Least and greatest value of a coordinate or channel.
void expectLimits(const PointCloud& cloud, const Converted& converted, const std::string& field, const json& limits) {
  std::array<double, 2> actual{};
  if (field == "x" || field == "y" || field == "z") {
    const int axis = field[0] - 'x';
    actual = {converted.cloud.box_min[axis], converted.cloud.box_max[axis]};
  } else {
    for (const nodes::ChannelInfo& channel : nodes::listChannels(cloud)) {
      if (channel.name == field) {
        std::vector<float> values(converted.cloud.points);
        const auto result = nodes::convertChannel(cloud, converted.cloud, channel, values);
        actual = {result.low, result.high};
      }
    }
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const double expected = limits[i].get<double>();
    EXPECT_NEAR(actual[i], expected, 1e-6 * std::max(1.0, std::abs(expected))) << field;
  }
}

TEST(RecordedClouds, HaveThePointsAndLimitsOfTheReferenceAnswers) {
  std::size_t compared = 0;
  for (const char* name : {"combined_scene_20s", "lidar_pcd_pair", "pcl_rgb_clouds", "velodyne_hdl32"}) {
    const json truth = json::parse(std::ifstream(kData / "truth" / (std::string(name) + ".json")));
    const std::vector<std::filesystem::path> files = {kData / "mcap_made" / (std::string(name) + ".mcap")};
    const auto recording = ingest::Recording::open(files);
    ASSERT_TRUE(recording) << recording.error().message;
    (*recording)->load();
    const scenegraph::ObjectStore& store = (*recording)->dataset()->store();
    for (const auto& [topic, about] : truth["topics"].items()) {
      if (about["type"] != "sensor_msgs/PointCloud2") {
        continue;
      }
      for (const json& sample : about["samples"]) {
        SCOPED_TRACE(std::string(name) + " " + topic + " " + sample["log_ns"].get<std::string>());
        const auto id = store.findTopic(topic);
        ASSERT_TRUE(id);
        const auto entry = store.newestAtOrBefore(*id, tf::TimePoint{std::stoll(sample["log_ns"].get<std::string>())});
        ASSERT_TRUE(entry);
        const auto object = store.decode(*id, *entry);
        ASSERT_TRUE(object) << object.error().message;
        const auto cloud = object->get<PointCloud>();
        ASSERT_NE(cloud, nullptr);
        const auto converted = convert(*cloud);
        ASSERT_TRUE(converted) << converted.error().message;
        EXPECT_EQ(converted->cloud.points, sample["finite_points"].get<std::size_t>());
        for (const auto& [field, limits] : sample["minmax_over_finite_points"].items()) {
          if (field != "rgb" && field != "rgba") {
            expectLimits(*cloud, *converted, field, limits);
            ++compared;
          }
        }
      }
    }
  }
  EXPECT_GT(compared, 60U);
}

TEST(RecordedClouds, ShowTheSameColoursPackedAsFloatAndAsInteger) {
  // The same Kinect frame is in one file as rgba UINT32 and in the other as rgb FLOAT32.
  std::array<std::vector<std::uint8_t>, 2> colors;
  const std::array<std::pair<const char*, const char*>, 2> sources = {
      {{"pcl_rgb_clouds", "/camera/points_rgba"}, {"combined_scene_20s", "/camera/depth/points"}}};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::vector<std::filesystem::path> files = {kData / "mcap_made" / (std::string(sources[i].first) + ".mcap")};
    const auto recording = ingest::Recording::open(files);
    ASSERT_TRUE(recording);
    (*recording)->load();
    const scenegraph::ObjectStore& store = (*recording)->dataset()->store();
    const auto id = store.findTopic(sources[i].second);
    ASSERT_TRUE(id);
    const auto cloud = store.decode(*id, *store.at(*id, 0))->get<PointCloud>();
    const auto converted = convert(*cloud);
    ASSERT_TRUE(converted);
    const auto source = nodes::findColors(*cloud);
    ASSERT_TRUE(source);
    colors[i].resize(4 * converted->cloud.points);
    nodes::convertColors(*cloud, converted->cloud, *source, colors[i]);
  }
  EXPECT_EQ(colors[0], colors[1]);
}

}  // namespace
}  // namespace stillframe::test
