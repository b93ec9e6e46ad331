#include "program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stillframe::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

void expectOneLine(const Outcome& run) {
  EXPECT_THAT(run.err, StartsWith("stillframe: "));
  EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
  EXPECT_TRUE(run.err.ends_with('\n'));
}

std::vector<std::string> keys(const nlohmann::json& object) {
  std::vector<std::string> names;
  for (const auto& [key, value] : object.items()) {
    names.push_back(key);
  }
  return names;
}

TEST(Program, ShowsHelpWithoutASubcommand) {
  const TestFolder folder;
  const Outcome help = run(folder.path(), {});
  EXPECT_EQ(help.code, 0);
  for (const char* name : {"view", "render", "info", "tf", "export", "sample", "bench", "accuracy"}) {
    EXPECT_THAT(help.out, HasSubstr(name));
    const Outcome of_command = run(folder.path(), {name, "--help"});
    EXPECT_EQ(of_command.code, 0) << name;
    EXPECT_THAT(of_command.out, HasSubstr("--help")) << name;
  }
}

TEST(Program, SaysItsVersion) {
  const TestFolder folder;
  const Outcome version = run(folder.path(), {"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_THAT(version.out, StartsWith("stillframe 0."));
}

TEST(Program, RefusesWhatItDoesNotUnderstand) {
  const TestFolder folder;
  const std::vector<std::vector<std::string>> mistakes{
      {"fly"},
      {"--nonsense"},
      {"info"},
      {"info", "a.mcap", "--nonsense"},
      {"tf", "a.mcap", "--target", "map"},
      {"tf", "a.mcap", "--target", "map", "--source", "odom", "--time", "soon"},
      {"info", "a.mcap", "--tf-time", "sidereal"},
      {"sample"},
      {"sample", "a.mcap", "--points", "0"},
      {"sample", "a.mcap", "--points", "-5"},
      {"sample", "a.mcap", "--seconds", "-1"},
      {"sample", "a.mcap", "--seconds", "1e9"},
      {"accuracy", "luck"},
      {"accuracy", "tf", "a.mcap"},
      {"bench", "--open"},
      {"bench", "--scrub"},
      {"bench", "--only", "poses", "--svg", "views.svg"},
      {"bench", "--only", "luck"},
      {"view", "--views", "0"},
      {"view", "--point-budget", "0"},
      {"view", "--point-budget", "nan"},
  };
  for (const auto& arguments : mistakes) {
    const Outcome refused = run(folder.path(), arguments);
    EXPECT_EQ(refused.code, 2) << testing::PrintToString(arguments);
    expectOneLine(refused);
  }
}

TEST(Program, SaysWhatIsWrongWithAFile) {
  const TestFolder folder;
  const std::vector<std::string> files{
      folder / "missing.mcap", folder.path().string(), folder.makeFile("empty.mcap", ""),
      folder.makeFile("text.mcap", "this is no recording"), folder.makeFile("two\nlines.mcap", "nor this")};
  for (const std::string& file : files) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"info", file}, {"tf", file, "--target", "a", "--source", "b"}, {"view", file}}) {
      const Outcome failed = run(folder.path(), arguments);
      EXPECT_EQ(failed.code, 1) << testing::PrintToString(arguments);
      expectOneLine(failed);
      EXPECT_THAT(failed.err, HasSubstr(file.substr(0, file.find('\n'))));
    }
  }
}

TEST(Program, SaysWhyASampleCannotBeWritten) {
  const TestFolder folder;
  for (const std::string& file : {folder.path().string(), folder / "no/such/folder/a.mcap", std::string("/dev/full")}) {
    const Outcome failed = run(folder.path(), {"sample", file, "--seconds", "0.1"});
    EXPECT_EQ(failed.code, 1) << file;
    expectOneLine(failed);
    EXPECT_THAT(failed.err, HasSubstr(file));
  }
}

TEST(Program, SaysBeforeItMeasuresThatAReportCannotBeWritten) {
  const TestFolder folder;
  const std::string file = folder.makeFile("file", "");
  const Outcome failed = run(folder.path(), {"accuracy", "tf", "--out", file + "/reports"});
  EXPECT_EQ(failed.code, 1);
  EXPECT_EQ(failed.out, "");
  expectOneLine(failed);
  EXPECT_THAT(failed.err, HasSubstr("file/reports"));
}

TEST(Program, TakesTheSampleOptions) {
  const TestFolder folder;
  const Outcome made = run(folder.path(), {"sample", "a.mcap", "--seconds", "0.5", "--points", "64", "--seed", "9"});
  EXPECT_EQ(made.code, 0) << made.err;
  const auto info = run(folder.path(), {"info", "a.mcap", "--json"}).json();
  EXPECT_EQ(info["end_ns"].get<std::int64_t>() - info["start_ns"].get<std::int64_t>(), 500'000'000);
}

TEST(Program, ListsARecording) {
  const TestFolder folder;
  const Outcome listed = run(folder.path(), {"info", folder.makeSample(), "--json"});
  ASSERT_EQ(listed.code, 0) << listed.err;
  EXPECT_EQ(listed.err, "");
  const auto info = listed.json();
  EXPECT_EQ(info["start_ns"], kSampleStart_ns);
  EXPECT_EQ(info["end_ns"], kSampleEnd_ns);
  EXPECT_TRUE(info["problems"].empty()) << info["problems"];
  ASSERT_GE(info["topics"].size(), 12U);
  const auto& camera = info["topics"][0];
  EXPECT_EQ(keys(camera),
            (std::vector<std::string>{"count", "encoding", "first_ns", "last_ns", "name", "schema", "type"}));
  EXPECT_EQ(camera["name"], "/camera/points");
  EXPECT_EQ(camera["schema"], "sensor_msgs/msg/PointCloud2");
  EXPECT_EQ(camera["encoding"], "cdr");
  EXPECT_EQ(camera["type"], "PointCloud");
  EXPECT_EQ(camera["count"], 11);
  EXPECT_EQ(camera["first_ns"], kSampleStart_ns);
  EXPECT_EQ(camera["last_ns"], kSampleEnd_ns);
  std::map<std::string, nlohmann::json> frames;
  for (const auto& frame : info["frames"]) {
    frames[frame["name"]] = frame;
  }
  ASSERT_EQ(frames.size(), 11U);
  EXPECT_EQ(frames["map"]["parent"], nullptr);
  EXPECT_EQ(frames["map"]["samples"], 0);
  EXPECT_EQ(frames["base_link"]["parent"], "odom");
  EXPECT_EQ(frames["base_link"]["samples"], 101);
  EXPECT_EQ(frames["odom"]["samples"], 5);
  EXPECT_EQ(frames["camera_optical_frame"]["parent"], "camera_link");
}

TEST(Program, ListsARecordingForPeople) {
  const TestFolder folder;
  const Outcome listed = run(folder.path(), {"info", folder.makeSample()});
  EXPECT_EQ(listed.code, 0);
  EXPECT_THAT(listed.out, HasSubstr("/lidar/points"));
  EXPECT_THAT(listed.out, HasSubstr("      base_link"));
}

TEST(Program, LooksUpATransform) {
  const TestFolder folder;
  const std::string sample = folder.makeSample();
  const Outcome found =
      run(folder.path(), {"tf", sample, "--target", "base_link", "--source", "lidar_link", "--time", "+1", "--json"});
  ASSERT_EQ(found.code, 0) << found.err;
  EXPECT_EQ(found.json(), nlohmann::json::parse(R"({"translation": [0.05, 0, 0.95], "rotation": [0, 0, 0, 1]})"));
  EXPECT_THAT(found.out, HasSubstr("0.050000000000000003"));  // all 17 digits
  const Outcome text = run(folder.path(), {"tf", sample, "--target", "base_link", "--source", "lidar_link"});
  EXPECT_EQ(text.code, 0);
  EXPECT_THAT(text.out, HasSubstr("translation 0.05"));
}

TEST(Program, HoldsTheLastTransformBeyondTheEnd) {
  const TestFolder folder;
  const std::string sample = folder.makeSample();
  const auto at = [&](const std::string& time) {
    return run(folder.path(), {"tf", sample, "--target", "map", "--source", "base_link", "--time", time, "--json"}).out;
  };
  EXPECT_EQ(at("end"), at("9223372036854775807"));
  EXPECT_NE(at("end"), at("start"));
}

TEST(Program, SaysWhichEdgeHasNoTransform) {
  const TestFolder folder;
  const std::string sample = folder.makeSample();
  const Outcome failed = run(folder.path(), {"tf", sample, "--target", "map", "--source", "base_link", "--time",
                                             "-9223372036854775808", "--json"});
  EXPECT_EQ(failed.code, 3);
  expectOneLine(failed);
  const auto error = failed.json()["error"];
  EXPECT_EQ(error["code"], "NoSampleAtTime");
  EXPECT_NE(error["message"], "");
  EXPECT_EQ(error["edge"], nlohmann::json::parse(R"({"parent": "odom", "child": "base_link"})"));
  EXPECT_EQ(error["first_ns"], kSampleStart_ns - 1'000'000);
  EXPECT_EQ(error["last_ns"], kSampleEnd_ns - 1'000'000);
  EXPECT_EQ(error["time_ns"], std::numeric_limits<std::int64_t>::min());
}

TEST(Program, SaysThatAFrameIsUnknown) {
  const TestFolder folder;
  const std::string sample = folder.makeSample();
  const Outcome source = run(folder.path(), {"tf", sample, "--target", "map", "--source", "moon", "--json"});
  EXPECT_EQ(source.code, 3);
  EXPECT_EQ(source.json()["error"]["code"], "UnknownSource");
  EXPECT_THAT(source.err, HasSubstr("moon"));
  const Outcome target = run(folder.path(), {"tf", sample, "--target", "moon", "--source", "map"});
  EXPECT_EQ(target.code, 3);
  EXPECT_THAT(target.err, HasSubstr("moon"));
}

TEST(Program, LetsStaticTransformsHoldForAllTime) {
  const TestFolder folder;
  const std::string sample = folder.makeSample();
  const std::vector<std::string> early{"tf", sample, "--target", "base_link", "--source", "lidar_link", "--time", "0"};
  EXPECT_EQ(run(folder.path(), early).code, 3);
  std::vector<std::string> always = early;
  always.emplace_back("--static-always");
  EXPECT_EQ(run(folder.path(), always).code, 0);
}

TEST(Program, NeedsADisplayForTheWindowOnly) {
  const TestFolder folder;
  ::unsetenv("DISPLAY");
  ::unsetenv("WAYLAND_DISPLAY");
  ::unsetenv("QT_QPA_PLATFORM");
  const Outcome failed = run(folder.path(), {"view", folder.makeSample()});
  EXPECT_EQ(failed.code, 1);
  expectOneLine(failed);
  EXPECT_THAT(failed.err, HasSubstr("render"));
}

TEST(Program, SaysThatTheDisplayDoesNotAnswer) {
  const TestFolder folder;
  ::unsetenv("WAYLAND_DISPLAY");
  ::unsetenv("QT_QPA_PLATFORM");
  ::setenv("DISPLAY", ":31999", 1);
  const Outcome failed = run(folder.path(), {"view", folder.makeSample()});
  ::unsetenv("DISPLAY");
  EXPECT_EQ(failed.code, 1);
  EXPECT_THAT(failed.err, HasSubstr("':31999' does not answer"));
}

TEST(Bench, PrintsWhatEarlierRunsMeasuredSideBySide) {
  const TestFolder folder;
  const auto run_of = [](const std::string& results) {
    return R"({"processor": "P", "cores": 2, "memcpy_mb_per_s": 9000.0, "renderer": "R", "version": "1", "date": "D",
               "results": [)" +
           results + "]}";
  };
  const std::string before = folder.makeFile(
      "before.json",
      run_of(R"({"name": "tick", "value": 16.25, "unit": "ms"}, {"name": "gone", "value": 10543.6, "unit": ""})"));
  const std::string after =
      folder.makeFile("after.json", run_of(R"({"name": "tick", "value": 0.0123, "unit": "ms", "at_most": 0.1})"));
  const Outcome outcome = run(folder.path(), {"bench", "--table", before, after});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "- before: P, 2 cores, memcpy 9000 MB/s; R; stillframe 1; D\n"
            "- after: P, 2 cores, memcpy 9000 MB/s; R; stillframe 1; D\n\n"
            "| what | before | after | target |\n|---|--:|--:|---|\n"
            "| tick (ms) | 16.25 | 0.0123 | at most 0.1 |\n"
            "| gone | 10544 |  |  |\n");
  const Outcome refused = run(folder.path(), {"bench", "--table", folder.makeFile("no.json", "[]")});
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.err.find("no.json"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace stillframe::cli
