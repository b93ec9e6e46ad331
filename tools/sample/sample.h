#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>

#include "scenegraph/status.h"

namespace stillframe::sample {

struct SampleOptions {
  std::int64_t duration_ns = 10'000'000'000;  ///< from the first to the last message
  std::uint32_t lidar_points = 28'800;        ///< of each lidar cloud; every one is a return
  std::uint64_t seed = 1;
};

/// What was written, for the line that says so.
struct SampleReport {
  std::uint64_t messages = 0;
  std::uint64_t bytes = 0;  ///< of messages, before compression
};

/// Writes the synthetic recording: a differential-drive robot in a small warehouse, with transforms, a spinning lidar
/// (raw and compressed), cameras, a scanner and maps, as a ROS 2 MCAP. The same options give the same file, byte for
/// byte. Takes about 0.2 s per second of it at the default size; memory is one cloud and one chunk.
[[nodiscard]] std::expected<SampleReport, scenegraph::Status> writeSample(const std::filesystem::path& path,
                                                                          const SampleOptions& options);

}  // namespace stillframe::sample
