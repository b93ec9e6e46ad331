// Recordings that this project did not make, held against answers that it did not compute.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "scenegraph/objects/point_cloud.h"
#include "tests/support/recordings.h"
#include "tools/ingest/recording.h"

namespace stillframe::ingest {
namespace {

using nlohmann::json;
using scenegraph::ObjectType;
using stillframe::test::kData;

std::vector<std::filesystem::path> recordings() {
  std::vector<std::filesystem::path> files;
  for (const char* folder : {"mcap_made", "mcap_real"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kData / folder)) {
      if (entry.path().extension() == ".mcap") {
        files.push_back(entry.path());
      }
    }
  }
  std::ranges::sort(files);
  return files;
}

std::unique_ptr<Recording> loaded(const std::filesystem::path& path) {
  auto recording = Recording::open(std::span(&path, 1), scenegraph::TfClock::Header);
  EXPECT_TRUE(recording) << recording.error().message;
  if (!recording) {
    return nullptr;
  }
  (*recording)->load();
  return *std::move(recording);
}

/// Recordings with reference answers.
std::vector<std::pair<std::filesystem::path, json>> answered() {
  std::vector<std::pair<std::filesystem::path, json>> all;
  for (const auto& path : recordings()) {
    const auto truth = kData / "truth" / (path.stem().string() + ".json");
    if (path.parent_path() == kData / "mcap_made" && std::filesystem::exists(truth)) {
      std::ifstream in(truth);
      all.emplace_back(path, json::parse(in));
    }
  }
  return all;
}

TEST(IngestData, EveryRecordingOpensAndLoads) {
  const auto files = recordings();
  ASSERT_GT(files.size(), 30u);
  for (const auto& path : files) {
    SCOPED_TRACE(path.string());
    const auto recording = loaded(path);
    ASSERT_NE(recording, nullptr);
    const bool is_damaged = path.stem().string().starts_with("BAD_truncated");
    std::vector<std::string> codes;
    for (const auto& problem : recording->dataset()->problems()) {
      codes.push_back(problem.code);
    }
    EXPECT_EQ(std::ranges::count(codes, "Truncated"), is_damaged ? 1 : 0) << testing::PrintToString(codes);
    EXPECT_THAT(codes, testing::Not(testing::Contains("StatisticsMismatch")));
    EXPECT_THAT(codes, testing::Not(testing::Contains("BadChunk")));
  }
}

TEST(IngestData, TopicsAreThoseOfTheReference) {
  for (const auto& [path, truth] : answered()) {
    SCOPED_TRACE(path.string());
    const auto recording = loaded(path);
    ASSERT_NE(recording, nullptr);
    const auto topics = recording->topics();
    EXPECT_EQ(topics.size(), truth["topics"].size());
    for (const auto& topic : topics) {
      SCOPED_TRACE(topic.name);
      ASSERT_TRUE(truth["topics"].contains(topic.name));
      const json& expected = truth["topics"][topic.name];
      EXPECT_EQ(topic.encoding, expected["encoding"].get<std::string>());
      EXPECT_EQ(topic.count, expected["count"].get<std::uint64_t>());
      EXPECT_EQ(std::to_string(topic.first.ns), expected["first_log_ns"].get<std::string>());
      EXPECT_EQ(std::to_string(topic.last.ns), expected["last_log_ns"].get<std::string>());
      EXPECT_EQ(topic.unsupported_reason.empty(), topic.type != ObjectType::None);
    }
  }
}

TEST(IngestData, TransformsAreThoseOfTheReference) {
  std::size_t edges = 0;
  for (const auto& [path, truth] : answered()) {
    if (!truth.contains("tf") || !truth["tf"].contains("samples_per_edge") ||
        path.filename().string().starts_with("foxglove")) {
      continue;
    }
    SCOPED_TRACE(path.string());
    const auto recording = loaded(path);
    ASSERT_NE(recording, nullptr);
    const auto& buffer = *recording->dataset()->transforms();
    for (const auto& [child, samples] : truth["tf"]["samples_per_edge"].items()) {
      SCOPED_TRACE(child);
      const auto frame = buffer.findFrame(child);
      ASSERT_TRUE(frame);
      const auto edge = buffer.edge(*frame);
      ASSERT_TRUE(edge);
      EXPECT_EQ(edge->samples, samples.get<std::size_t>());
      EXPECT_EQ(edge->parent, truth["tf"]["parents"][child].get<std::string>());
      const json& range = truth["tf"]["stamp_range_per_edge_ns"][child];
      EXPECT_EQ(std::to_string(edge->first.ns), range[0].get<std::string>());
      EXPECT_EQ(std::to_string(edge->last.ns), range[1].get<std::string>());
      ++edges;
    }
  }
  EXPECT_GT(edges, 50u);
}

TEST(IngestData, CloudsAreThoseOfTheReference) {
  std::size_t clouds = 0;
  for (const auto& [path, truth] : answered()) {
    SCOPED_TRACE(path.string());
    const auto recording = loaded(path);
    ASSERT_NE(recording, nullptr);
    const auto& store = recording->dataset()->store();
    for (const auto& topic : recording->topics()) {
      if (topic.schema.find("PointCloud2") == std::string::npos || topic.type != ObjectType::PointCloud) {
        continue;
      }
      SCOPED_TRACE(topic.name);
      for (const json& sample : truth["topics"][topic.name]["samples"]) {
        const auto id = *store.findTopic(topic.name);
        const auto entry = store.newestAtOrBefore(id, {std::stoll(sample["log_ns"].get<std::string>())});
        ASSERT_TRUE(entry);
        const auto object = store.decode(id, *entry);
        ASSERT_TRUE(object) << object.error().message;
        const auto cloud = object->get<scenegraph::PointCloud>();
        ASSERT_NE(cloud, nullptr);
        EXPECT_EQ(cloud->width, sample["width"].get<std::uint32_t>());
        EXPECT_EQ(cloud->height, sample["height"].get<std::uint32_t>());
        EXPECT_EQ(cloud->point_step, sample["point_step"].get<std::uint32_t>());
        ++clouds;
      }
    }
  }
  EXPECT_GT(clouds, 10u);
}

}  // namespace
}  // namespace stillframe::ingest
