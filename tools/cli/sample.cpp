#include "tools/sample/sample.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "tools/cli/commands.h"
#include "tools/cli/recording_options.h"
#include "tools/cli/time_argument.h"

namespace stillframe::cli {
namespace {

constexpr std::int64_t kLongest_s = 86'400;
constexpr std::uint32_t kMostPoints = 20'000'000;

struct SampleCommandOptions {
  std::string file;
  std::string seconds = "10";
  sample::SampleOptions sample;
};

Result<void> runSample(const SampleCommandOptions& options) {
  sample::SampleOptions sample = options.sample;
  const auto duration = parseTime("+" + options.seconds);
  if (!duration || duration->offset_ns > kLongest_s * 1'000'000'000) {
    return usageError("--seconds '" + options.seconds + "' is not a decimal number from 0 to " +
                      std::to_string(kLongest_s));
  }
  sample.duration_ns = duration->offset_ns;
  const auto report = sample::writeSample(options.file, sample);
  if (!report) {
    return std::unexpected(fileError(options.file, report.error()));
  }
  std::printf("%s: %s s, %llu messages, %.1f MB before compression\n", printable(options.file).c_str(),
              options.seconds.c_str(), static_cast<unsigned long long>(report->messages),
              static_cast<double>(report->bytes) * 1e-6);
  return {};
}

}  // namespace

Command addSampleCommand(CLI::App& app) {
  auto options = std::make_shared<SampleCommandOptions>();
  app.add_option("OUT", options->file, "The MCAP file to write")->required();
  app.add_option("--seconds", options->seconds, "Length of the recording")->capture_default_str();
  app.add_option("--points", options->sample.lidar_points, "Points of each lidar cloud")
      ->check(CLI::Range(std::uint32_t{1}, kMostPoints))
      ->capture_default_str();
  app.add_option("--seed", options->sample.seed, "Another seed, another warehouse and drive")->capture_default_str();
  return [options] { return runSample(*options); };
}

}  // namespace stillframe::cli
