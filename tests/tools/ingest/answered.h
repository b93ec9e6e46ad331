#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "tools/ingest/recording.h"

namespace stillframe::ingest::test {

inline std::filesystem::path dataFolder() { return STILLFRAME_TEST_DATA; }

/// A recording of mcap_made (or a path below the data) and its reference answers.
class Answered {
 public:
  explicit Answered(const std::string& name) {
    const auto made = dataFolder() / "mcap_made" / (name + ".mcap");
    const auto path = std::filesystem::exists(made) ? made : dataFolder() / name;
    auto opened = Recording::open(std::span(&path, 1), scenegraph::TfClock::Header);
    EXPECT_TRUE(opened) << opened.error().message;
    recording = *std::move(opened);
    recording->load();
    if (std::ifstream in(dataFolder() / "truth" / (name + ".json")); in) {
      truth = nlohmann::json::parse(in);
    }
  }
  /// The newest object of a topic at that time.
  scenegraph::AnyObject at(const std::string& topic, std::int64_t time_ns = INT64_MAX) const {
    const auto& store = recording->dataset()->store();
    const auto id = store.findTopic(topic);
    EXPECT_TRUE(id) << topic;
    const auto entry = store.newestAtOrBefore(*id, {time_ns});
    EXPECT_TRUE(entry) << topic;
    auto object = store.decode(*id, *entry);
    EXPECT_TRUE(object) << topic << ": " << object.error().message;
    return object ? *object : scenegraph::AnyObject{};
  }
  /// Calls check(object, sample) for every reference sample of the topics of that schema.
  template <typename Object, typename Check>
  std::size_t eachSample(std::string_view schema, const Check& check) const {
    std::size_t samples = 0;
    for (const auto& [topic, facts] : truth["topics"].items()) {
      if (facts["type"] != schema) {
        continue;
      }
      for (const nlohmann::json& sample : facts["samples"]) {
        SCOPED_TRACE(topic);
        const scenegraph::AnyObject any = at(topic, std::stoll(sample["log_ns"].template get<std::string>()));
        const std::shared_ptr<const Object> object = any.get<Object>();
        EXPECT_NE(object, nullptr);
        if (object != nullptr) {
          check(*object, sample);
          ++samples;
        }
      }
    }
    return samples;
  }

  std::unique_ptr<Recording> recording;
  nlohmann::json truth;
};

}  // namespace stillframe::ingest::test
