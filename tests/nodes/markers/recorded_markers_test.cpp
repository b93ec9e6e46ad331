// Markers of recordings that others made, against answers that other code computed.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "nodes/markers/scene_history.h"
#include "tests/support/recordings.h"
#include "tools/ingest/recording.h"

namespace stillframe::nodes {
namespace {

namespace fs = std::filesystem;
using test::kData;

/// "ns|id" of "LENGTH:ns:id".
std::string named(const std::string& id) {
  const std::size_t colon = id.find(':');
  const std::size_t length = std::stoul(id.substr(0, colon));
  return id.substr(colon + 1, length) + "|" + id.substr(colon + 2 + length);
}

class RecordedMarkers : public testing::TestWithParam<const char*> {};

TEST_P(RecordedMarkers, LiveWhenOtherCodeSaysSo) {
  const std::vector<fs::path> files{kData / "mcap_made" / (std::string(GetParam()) + ".mcap")};
  const auto recording = ingest::Recording::open(files);
  ASSERT_TRUE(recording) << recording.error().message;
  (*recording)->load();
  const scenegraph::ObjectStore& store = (*recording)->dataset()->store();
  const auto truth = nlohmann::json::parse(std::ifstream(kData / "truth" / (std::string(GetParam()) + ".json")));
  std::map<std::string, SceneHistory> histories;
  auto moments = truth.at("markers_alive").get<std::vector<nlohmann::json>>();
  std::ranges::reverse(moments);  // back in time
  for (const auto& moment : moments) {
    const tf::TimePoint time{std::stoll(moment.at("t_ns").get<std::string>())};
    std::set<std::string> expected;
    for (const auto& text : moment.at("alive")) {
      const auto marker = text.get<std::string>();
      expected.insert(marker.substr(0, marker.rfind('|')));
    }
    std::set<std::string> alive;
    for (scenegraph::TopicId topic = 0; topic < store.topicCount(); ++topic) {
      const auto info = store.topic(topic);
      if (info.type != scenegraph::ObjectType::SceneEntities) {
        continue;
      }
      const SceneState state = histories[info.name].at(
          store.countAtOrBefore(topic, time), time, [&](std::size_t place) { return store.at(topic, place)->sequence; },
          [&](std::size_t place) {
            const auto entry = store.at(topic, place);
            return SceneMessage{entry->log_time, entry->sequence, entry->payload_bytes,
                                store.decode(topic, *entry)->get<scenegraph::SceneEntities>()};
          });
      for (std::size_t slot = 0; slot < state.slotCount(); ++slot) {
        if (state.at(slot) != nullptr) {
          alive.insert(info.name + "|" + named(state.at(slot)->id));
        }
      }
    }
    EXPECT_EQ(alive, expected) << "at " << time.ns;
  }
}

INSTANTIATE_TEST_SUITE_P(Files, RecordedMarkers, testing::Values("markers_all_types", "combined_scene_20s"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace stillframe::nodes
