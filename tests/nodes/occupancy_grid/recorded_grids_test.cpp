#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "nodes/occupancy_grid/grid_tracker.h"
#include "nodes/registry.h"
#include "scenegraph/scene.h"
#include "tests/nodes/occupancy_grid/sha256.h"
#include "tests/support/recordings.h"
#include "tools/ingest/recording.h"

namespace stillframe::test {
namespace {

using nlohmann::json;
using scenegraph::ObjectType;

tf::TimePoint timeOf(const json& ns) { return {std::stoll(ns.get<std::string>())}; }

std::string hashOf(const nodes::GridSnapshot& snapshot) {
  std::vector<std::int8_t> cells;
  for (std::uint32_t y = 0; y < snapshot.header.height; ++y) {
    for (std::uint32_t x = 0; x < snapshot.header.width; ++x) {
      cells.push_back(snapshot.state->cells.at(x, y));
    }
  }
  return sha256(cells);
}

class RecordedGrids : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    truth = json::parse(std::ifstream(kData / "truth" / (std::string(GetParam()) + ".json")));
    const std::vector<std::filesystem::path> files = {kData / "mcap_made" / (std::string(GetParam()) + ".mcap")};
    auto opened = ingest::Recording::open(files);
    ASSERT_TRUE(opened) << opened.error().message;
    recording = std::move(*opened);
    recording->load();
  }
  json truth;
  std::unique_ptr<ingest::Recording> recording;
  std::unique_ptr<scenegraph::Executor> executor = scenegraph::makeSynchronousExecutor();
};

TEST_P(RecordedGrids, HaveTheCellsOfTheReferenceAnswersInAnyOrder) {
  const auto& dataset = recording->dataset();
  scenegraph::FrameGraph frames(dataset->transforms());
  std::size_t compared = 0;
  for (const auto& [topic, about] : truth["occupancy"].items()) {
    if (!dataset->store().findTopic(topic, ObjectType::OccupancyGrid)) {
      EXPECT_TRUE(nodes::isOrphan(dataset->store(), topic + "_updates")) << topic;
      continue;
    }
    nodes::GridTracker tracker({*dataset, frames, *executor, {}}, topic);
    auto snapshots = about["snapshots"].get<std::vector<json>>();
    for (int round = 0; round < 2; ++round) {
      for (const json& snapshot : snapshots) {
        SCOPED_TRACE(topic + " " + snapshot["log_ns"].get<std::string>());
        // The answers leave an update out that reaches beyond its grid, where here its inner part is applied.
        auto time = timeOf(snapshot["log_ns"]);
        for (const json& left_out : about["updates_not_applicable_as_sent_log_ns"]) {
          time = std::min(time, tf::TimePoint{timeOf(left_out).ns - 1});
        }
        (void)tracker.update(time);
        if (tracker.product() == nullptr) {
          EXPECT_EQ(tracker.status().level, scenegraph::StatusLevel::Error);
          EXPECT_TRUE(snapshot["sha256_int8_rowmajor"].is_null() || topic.contains("BAD_")) << tracker.status().message;
          continue;
        }
        const nodes::GridSnapshot& shown = *tracker.product();
        EXPECT_EQ(shown.header.width, snapshot["width"].get<std::uint32_t>());
        EXPECT_EQ(shown.header.height, snapshot["height"].get<std::uint32_t>());
        EXPECT_EQ(hashOf(shown), snapshot["sha256_int8_rowmajor"].get<std::string>());
        EXPECT_EQ(shown.state->cells.counts().unknown, snapshot["unknown"].get<std::uint64_t>());
        const auto invalid_high = [&] {
          std::uint64_t count = 0;
          for (std::uint32_t y = 0; y < shown.header.height; ++y) {
            for (std::uint32_t x = 0; x < shown.header.width; ++x) {
              count += shown.state->cells.at(x, y) > 100 ? 1U : 0U;
            }
          }
          return count;
        }();
        EXPECT_EQ(shown.state->cells.counts().occupied + invalid_high, snapshot["ge65"].get<std::uint64_t>());
        ++compared;
      }
      std::ranges::reverse(snapshots);
    }
    // Each update that cannot be applied as it was sent is refused or clipped.
    const auto& not_applicable = about["updates_not_applicable_as_sent_log_ns"];
    if (tracker.product() != nullptr && !not_applicable.empty()) {
      (void)tracker.update(timeOf(not_applicable.back()));
      EXPECT_EQ(tracker.product()->state->refused + tracker.product()->state->clipped, not_applicable.size())
          << tracker.product()->state->first_refusal;
      EXPECT_GE(tracker.product()->state->clipped, 1U);
    }
  }
  EXPECT_GE(compared, 8U);
}

TEST_P(RecordedGrids, AreShownOrTheReasonIsTold) {
  scenegraph::Scene scene(recording->dataset(), nodes::layerTypes(), *executor);
  scene.setFixedFrame("map");
  scene.addDefaultLayers();
  scene.update(recording->dataset()->timeRange()->second);
  const std::set<std::string> expected_not_ok = {"/maps/BAD_huge", "/maps/BAD_short_data", "/maps/BAD_zero_resolution",
                                                 "/maps/empty", "/maps_updates/orphan_map_updates"};
  std::size_t grids = 0;
  for (const auto& slot : scene.layers()) {
    if (slot->type->name == "occupancy_grid") {
      ++grids;
      const bool is_drawn = slot->layer->boundsInFixed().valid();
      EXPECT_EQ(is_drawn, !expected_not_ok.contains(slot->topic))
          << slot->topic << ": " << slot->layer->status().message;
      EXPECT_TRUE(is_drawn || slot->layer->status().code != "Ok") << slot->topic;
    }
  }
  EXPECT_GE(grids, 1U);
}

INSTANTIATE_TEST_SUITE_P(Files, RecordedGrids, testing::Values("intel_lab_2d_slam", "nav2_maps", "combined_scene_20s"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace stillframe::test
