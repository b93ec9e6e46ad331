#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace stillframe::cli {

/// What a run of the program left behind.
struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
  [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(out, nullptr, false); }
};

/// Runs the program as a user would, from `folder`.
[[nodiscard]] Outcome run(const std::filesystem::path& folder, const std::vector<std::string>& arguments);

/// A folder of one test, gone after it, with a short sample recording in it when asked for.
class TestFolder {
 public:
  TestFolder();
  ~TestFolder();
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::string operator/(const char* name) const { return (path_ / name).string(); }
  /// Two seconds, 2000 points a cloud.
  [[nodiscard]] std::string makeSample() const;
  /// A file of these bytes.
  [[nodiscard]] std::string makeFile(const char* name, const std::string& bytes) const;

 private:
  std::filesystem::path path_;
};

/// First and last log time of that sample.
inline constexpr std::int64_t kSampleStart_ns = 1'700'000'000'001'000'000;
inline constexpr std::int64_t kSampleEnd_ns = kSampleStart_ns + 2'000'000'000;
inline constexpr int kSamplePoints = 2000;

}  // namespace stillframe::cli
