#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tools/ingest/recording.h"
#include "tools/sample/sample.h"

namespace stillframe::sample {

/// A sample recording of its own for each test, written and opened again.
class RecordedSample : public testing::Test {
 public:
  static constexpr SampleOptions kOptions{.duration_ns = 8'000'000'000, .lidar_points = 100, .seed = 1};
  static constexpr std::int64_t kStart_ns = 1'700'000'000'000'000'000;

 protected:
  RecordedSample()
      : path_(std::filesystem::path(testing::TempDir()) /
              (std::string("stillframe_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".mcap")) {
    EXPECT_TRUE(writeSample(path_, kOptions));
    const std::vector<std::filesystem::path> files{path_};
    auto recording = ingest::Recording::open(files);
    EXPECT_TRUE(recording);
    recording_ = std::move(*recording);
    recording_->load();
    recording_->dataset()->takeTransforms();
  }
  ~RecordedSample() override { std::filesystem::remove(path_); }

  /// All messages of a topic.
  template <typename T>
  std::vector<std::shared_ptr<const T>> messages(const char* topic) const {
    const scenegraph::ObjectStore& store = recording_->dataset()->store();
    std::vector<std::shared_ptr<const T>> result;
    const auto id = store.findTopic(topic, T::kType);
    for (std::size_t i = 0; id && i < store.entryCount(*id); ++i) {
      const auto object = store.decode(*id, *store.at(*id, i));
      EXPECT_TRUE(object);
      result.push_back(object->template get<T>());
    }
    return result;
  }

  std::filesystem::path path_;
  std::shared_ptr<ingest::Recording> recording_;
};

}  // namespace stillframe::sample
