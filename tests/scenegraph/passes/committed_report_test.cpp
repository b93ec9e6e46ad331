#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>

#include "scenegraph/passes/view_effects.h"

namespace stillframe::scenegraph {
namespace {

/// What the report in the documentation says of one subject: what its measurements speak for, and what was in use.
struct Default {
  std::string spoken_for;
  std::string in_use;
};

std::map<std::string, Default> defaultsOfReport() {
  std::ifstream report(std::string(STILLFRAME_SOURCE_DIR) + "/tools/doc/post.md");
  std::map<std::string, Default> defaults;
  const auto between = [](const std::string& line, const std::string& before, const std::string& behind) {
    const std::size_t start = line.find(before) + before.size();
    return line.substr(start, line.find(behind, start) - start);
  };
  for (std::string line; std::getline(report, line);) {
    if (line.starts_with("- ")) {
      defaults[between(line, "- ", ": ")] = {between(line, "**", "**"), between(line, "in use: ", ".")};
    }
  }
  return defaults;
}

TEST(CommittedReport, SpeaksForTheDefaultsInUse) {
  const ViewEffects effects;
  const SettingTexts ssao = effects.settings("ssao");
  const std::string occlusion = ssao.at("samples") + " samples" +
                                (ssao.at("half_resolution") == "true" ? ", half resolution" : "") +
                                (ssao.at("smoothing") == "true" ? "" : ", not smoothed");
  const SettingTexts aa = effects.settings("aa");
  const std::map<std::string, std::string> in_use{
      {"ambient occlusion, radius 0.25 m", occlusion},
      {"ambient occlusion, radius 0.5 m", occlusion},
      {"ambient occlusion, radius 1 m", occlusion},
      {"eye-dome lighting", effects.settings("edl").at("neighbours") + " neighbours"},
      {"target formats", PostChain{}.scene_format == TargetFormat::Rgba16F ? "RGBA16F" : "another"},
      {"anti-aliasing", aa.at("mode") + ", " + aa.at("samples") + " samples"}};
  const auto report = defaultsOfReport();
  ASSERT_EQ(report.size(), in_use.size());
  for (const auto& [subject, value] : in_use) {
    ASSERT_TRUE(report.contains(subject)) << subject;
    EXPECT_EQ(report.at(subject).spoken_for, value) << subject;
    EXPECT_EQ(report.at(subject).in_use, value) << subject;
  }
}

}  // namespace
}  // namespace stillframe::scenegraph
