#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "tools/ingest/mcap_file.h"
#include "tools/sample/sample.h"

namespace stillframe::sample {
namespace {

namespace fs = std::filesystem;

class SampleFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("stillframe_sample_") + test->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string bytesOf(const SampleOptions& options, const char* name) const {
    const fs::path path = folder_ / name;
    EXPECT_TRUE(writeSample(path, options));
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  fs::path folder_;
};

constexpr SampleOptions kShort{.duration_ns = 1'000'000'000, .lidar_points = 1000, .seed = 4};

TEST_F(SampleFile, IsTheSameForTheSameSeed) {
  const std::string first = bytesOf(kShort, "a.mcap");
  EXPECT_GT(first.size(), 100'000U);
  EXPECT_TRUE(first == bytesOf(kShort, "b.mcap"));
}

TEST_F(SampleFile, IsAnotherForAnotherSeed) {
  SampleOptions other = kShort;
  other.seed = 5;
  EXPECT_FALSE(bytesOf(kShort, "a.mcap") == bytesOf(other, "b.mcap"));
}

TEST_F(SampleFile, HoldsEveryTopicAtItsRate) {
  const fs::path path = folder_ / "a.mcap";
  const auto report = writeSample(path, kShort);
  ASSERT_TRUE(report);
  const auto file = ingest::McapFile::open(path);
  ASSERT_TRUE(file);
  EXPECT_FALSE((*file)->isScanned());
  ASSERT_TRUE((*file)->statistics());
  const auto& statistics = *(*file)->statistics();
  std::map<std::string, std::uint64_t> counts;
  for (const auto& [id, count] : statistics.channel_counts) {
    counts[(*file)->channels().at(id).topic] = count;
  }
  const std::map<std::string, std::uint64_t> expected{{"/tf_static", 1},
                                                      {"/tf", 51 + 3},
                                                      {"/lidar/points", 11},
                                                      {"/lidar/thin/cloudini", 6},
                                                      {"/lidar/thin/draco", 6},
                                                      {"/camera/points", 6},
                                                      {"/rear_camera/depth/image_raw", 3},
                                                      {"/rear_camera/depth/camera_info", 3},
                                                      {"/scan", 6},
                                                      {"/elevation_map", 1},
                                                      {"/voxels", 1},
                                                      {"/map", 1},
                                                      {"/map_updates", 3},
                                                      {"/robot_description", 1},
                                                      {"/joint_states", 11},
                                                      {"/odom", 11},
                                                      {"/path", 3},
                                                      {"/particles", 3},
                                                      {"/footprint", 1},
                                                      {"/markers", 5}};
  EXPECT_EQ(counts, expected);
  EXPECT_EQ(statistics.end_time - statistics.start_time, 1'000'000'000U);
  std::uint64_t messages = 0;
  for (const auto& [topic, count] : expected) {
    messages += count;
  }
  EXPECT_EQ(report->messages, messages);
}

TEST_F(SampleFile, SaysWhyItCannotBeWritten) {
  const auto report = writeSample(folder_, kShort);
  ASSERT_FALSE(report);
  EXPECT_THAT(report.error().message, testing::HasSubstr(folder_.string()));
  EXPECT_FALSE(writeSample(folder_ / "no" / "such" / "folder.mcap", kShort));
}

}  // namespace
}  // namespace stillframe::sample
