#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "nodes/images/camera_model.h"
#include "nodes/images/depth_map.h"
#include "scenegraph/objects/image.h"
#include "tests/support/recordings.h"
#include "tools/ingest/recording.h"

namespace stillframe::test {
namespace {

using nlohmann::json;

template <typename T>
std::shared_ptr<const T> objectAt(const scenegraph::ObjectStore& store, const std::string& topic, std::int64_t ns) {
  const auto id = store.findTopic(topic);
  const auto entry = id ? store.newestAtOrBefore(*id, tf::TimePoint{ns}) : std::nullopt;
  const auto object = entry ? store.decode(*id, *entry) : std::unexpected(scenegraph::DecodeError{});
  return object ? object->template get<T>() : nullptr;
}

TEST(RecordedDepth, HasThePixelsLimitsAndCentroidsOfTheReferenceAnswers) {
  std::size_t compared = 0;
  for (const char* name : {"combined_scene_20s", "realsense_depth_color", "slambook_rgbd"}) {
    const json truth = json::parse(std::ifstream(kData / "truth" / (std::string(name) + ".json")));
    const std::vector<std::filesystem::path> files = {kData / "mcap_made" / (std::string(name) + ".mcap")};
    const auto recording = ingest::Recording::open(files);
    ASSERT_TRUE(recording) << recording.error().message;
    (*recording)->load();
    const scenegraph::ObjectStore& store = (*recording)->dataset()->store();
    for (const auto& [topic, about] : truth["topics"].items()) {
      if (about["type"] != "sensor_msgs/Image") {
        continue;
      }
      for (const json& sample : about["samples"]) {
        if (!sample.contains("valid_pixels")) {
          continue;
        }
        SCOPED_TRACE(std::string(name) + " " + topic + " " + sample["log_ns"].get<std::string>());
        const std::int64_t ns = std::stoll(sample["log_ns"].get<std::string>());
        const auto image = objectAt<scenegraph::Image>(store, topic, ns);
        ASSERT_NE(image, nullptr);
        const auto map = nodes::decodeDepth(*image);
        ASSERT_TRUE(map) << map.error().message;
        EXPECT_EQ(map->valid, sample["valid_pixels"].get<std::size_t>());
        EXPECT_NEAR(map->nearest_m, sample["depth_m_minmax"][0].get<double>(), 1e-6);
        EXPECT_NEAR(map->farthest_m, sample["depth_m_minmax"][1].get<double>(), 1e-6);
        const auto info =
            objectAt<scenegraph::CameraInfo>(store, topic.substr(0, topic.rfind('/')) + "/camera_info", ns);
        ASSERT_NE(info, nullptr);
        const auto model = nodes::CameraModel::make(*info, map->width, map->height, nodes::PixelGrid::Raw);
        ASSERT_TRUE(model) << model.error().message;
        const auto rays = nodes::makeRays(*model, map->width, map->height);
        std::array<double, 3> sum{};
        for (std::size_t i = 0; i < map->metres.size(); ++i) {
          for (std::size_t axis = 0; axis < 3 && map->metres[i] > 0.0F; ++axis) {
            sum[axis] += static_cast<double>(rays.xyz[3 * i + axis] * map->metres[i]);
          }
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
          EXPECT_NEAR(sum[axis] / static_cast<double>(map->valid), sample["centroid_optical_frame"][axis].get<double>(),
                      2e-6)
              << axis;
        }
        ++compared;
      }
    }
  }
  EXPECT_GE(compared, 14U);
}

}  // namespace
}  // namespace stillframe::test
