#include "program.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>

#include "tools/sample/sample.h"

namespace stillframe::cli {
namespace {

namespace fs = std::filesystem;

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) {
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return text + "'";
}

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

Outcome run(const fs::path& folder, const std::vector<std::string>& arguments) {
  const fs::path errors = folder / "stderr.txt";
  std::string command = "cd " + quoted(folder.string()) + " && " + quoted(STILLFRAME_PROGRAM);
  for (const std::string& argument : arguments) {
    command += " " + quoted(argument);
  }
  command += " </dev/null 2>" + quoted(errors.string());
  Outcome result;
  FILE* const pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) {
    return result;
  }
  char buffer[4096];
  for (std::size_t got = 0; (got = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) {
    result.out.append(buffer, got);
  }
  const int status = ::pclose(pipe);
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.err = contents(errors);
  return result;
}

TestFolder::TestFolder() {
  const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
  path_ =
      fs::path(testing::TempDir()) / ("stillframe_cli_" + std::string(test->test_suite_name()) + "_" + test->name());
  fs::remove_all(path_);
  fs::create_directories(path_);
}

TestFolder::~TestFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string TestFolder::makeSample() const {
  const sample::SampleOptions options{.duration_ns = 2'000'000'000, .lidar_points = kSamplePoints, .seed = 2};
  EXPECT_TRUE(sample::writeSample(path_ / "sample.mcap", options));
  return (path_ / "sample.mcap").string();
}

std::string TestFolder::makeFile(const char* name, const std::string& bytes) const {
  std::ofstream(path_ / name, std::ios::binary) << bytes;
  return (path_ / name).string();
}

}  // namespace stillframe::cli
