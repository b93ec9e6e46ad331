#pragma once

#include <unistd.h>
#include <filesystem>
#include <string>

namespace stillframe::cli {

/// Where a sample recording may be written that is gone at the end. One at a time.
class TemporarySample {
 public:
  TemporarySample()
      : path_(std::filesystem::temp_directory_path() / ("stillframe-" + std::to_string(::getpid()) + ".mcap")) {}
  ~TemporarySample() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporarySample(const TemporarySample&) = delete;
  TemporarySample& operator=(const TemporarySample&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace stillframe::cli
