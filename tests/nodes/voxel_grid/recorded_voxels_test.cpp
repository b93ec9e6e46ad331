#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nodes/registry.h"
#include "scenegraph/executor.h"
#include "scenegraph/scene.h"
#include "tests/support/recordings.h"
#include "tools/ingest/recording.h"

namespace stillframe::test {
namespace {

using nlohmann::json;

/// Counts of every layer of voxels at the end of a recording, each with the status Ok.
std::map<std::string, std::map<std::string, std::uint64_t>> countsAtTheEndOf(const std::string& name) {
  const std::vector<std::filesystem::path> files = {kData / "mcap_made" / (name + ".mcap")};
  auto opened = ingest::Recording::open(files);
  EXPECT_TRUE(opened) << opened.error().message;
  (*opened)->load();
  const auto executor = scenegraph::makeSynchronousExecutor();
  scenegraph::Scene scene((*opened)->dataset(), nodes::layerTypes(), *executor);
  scene.addDefaultLayers();
  scene.update((*opened)->dataset()->timeRange()->second);
  std::map<std::string, std::map<std::string, std::uint64_t>> counts;
  for (const auto& slot : scene.layers()) {
    if (slot->type->name == "voxel_grid") {
      EXPECT_EQ(slot->layer->status().code, "Ok") << slot->topic << ": " << slot->layer->status().message;
      EXPECT_TRUE(slot->layer->boundsInFixed().valid()) << slot->topic;
      for (const auto& [what, count] : slot->layer->counts()) {
        counts[slot->topic][what] = count;
      }
    }
  }
  return counts;
}

TEST(RecordedVoxels, HaveTheVoxelsOfTheReferenceAnswers) {
  const json truth = json::parse(std::ifstream(kData / "truth" / "combined_scene_20s.json"));
  const json& sample = truth["topics"]["/voxels"]["samples"][0];
  auto counts = countsAtTheEndOf("combined_scene_20s");
  ASSERT_EQ(counts.size(), 1U);
  EXPECT_EQ(counts["/voxels"]["voxels"], sample["cells"].get<std::uint64_t>());
  EXPECT_EQ(counts["/voxels"]["drawn"], sample["cells_with_any_nonzero_byte"].get<std::uint64_t>());
}

TEST(RecordedVoxels, AreDrawnFromProtobufWithPaddingFloatsAndColours) {
  auto counts = countsAtTheEndOf("foxglove_protobuf_scene");
  ASSERT_EQ(counts.size(), 3U);
  EXPECT_EQ(counts["/voxels/occupancy"]["voxels"], 58'560U);
  EXPECT_EQ(counts["/voxels/cost_float"]["voxels"], 1'536U);
  EXPECT_EQ(counts["/voxels/cost_float"]["bytes"], 12'288U);
  // The same scene twice, once as a cost and once as colours.
  EXPECT_EQ(counts["/voxels/rgba"]["drawn"], counts["/voxels/cost_float"]["drawn"]);
  EXPECT_LT(counts["/voxels/rgba"]["listed"], counts["/voxels/rgba"]["voxels"] / 2);
}

}  // namespace
}  // namespace stillframe::test
