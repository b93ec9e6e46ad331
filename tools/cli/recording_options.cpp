#include "tools/cli/recording_options.h"

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <map>

#include "tools/ingest/robot_topics.h"

namespace stillframe::cli {
namespace {

const std::map<std::string, scenegraph::TfClock>& clocks() {
  static const std::map<std::string, scenegraph::TfClock> kClocks{
      {"auto", scenegraph::TfClock::Auto}, {"header", scenegraph::TfClock::Header}, {"log", scenegraph::TfClock::Log}};
  return kClocks;
}

/// Length of the well-formed UTF-8 sequence at the head of `text`; 0 when there is none.
std::size_t sequenceLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char head = byte(0);
  const std::size_t length = head < 0x80 ? 1 : head >= 0xC2 && head < 0xE0 ? 2 : head >= 0xE0 && head < 0xF0 ? 3 : 4;
  if (length > text.size() || (length == 4 && (head < 0xF0 || head > 0xF4))) {
    return 0;
  }
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) {
      return 0;
    }
  }
  return length;
}

}  // namespace

void addRecordingOptions(CLI::App& command, RecordingOptions& options) {
  command.add_option("FILE", options.file, "The recording, an MCAP file")->required();
  addTransformOptions(command, options);
}

void addTransformOptions(CLI::App& command, RecordingOptions& options) {
  command
      .add_option_function<std::string>(
          "--tf-time", [&options](const std::string& text) { options.clock = clocks().at(text); },
          "Clock of the transforms: their header stamps, their log times, or auto: header stamps unless they ride "
          "another epoch than the log")
      ->type_name("auto|header|log")
      ->default_str("auto")
      ->check(CLI::IsMember({"auto", "header", "log"}));
  command.add_flag("--static-always", options.static_always,
                   "Static transforms hold for all time, not only from their stamp on");
}

void addRobotOptions(CLI::App& command, RecordingOptions& options) {
  command
      .add_option("--package-path", options.package_paths,
                  "Package, folder of packages or workspace where meshes are looked for; may be repeated")
      ->type_name("FOLDER")
      ->allow_extra_args(false);
  command.add_option("--robot", options.robots, "A URDF file to show with the recording; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
}

std::expected<void, scenegraph::Status> addRobots(scenegraph::Dataset& dataset, const RecordingOptions& options) {
  dataset.resources().setSearchPaths({options.package_paths.begin(), options.package_paths.end()});
  for (const std::string& file : options.robots) {
    if (auto added = ingest::addRobotFile(dataset, file); !added) {
      return added;
    }
  }
  return {};
}

Result<scenegraph::TfClock> parseTfClock(std::string_view text) {
  const auto found = clocks().find(std::string(text));
  if (found == clocks().end()) {
    return usageError("clock '" + std::string(text) + "' is not auto, header or log");
  }
  return found->second;
}

Result<std::unique_ptr<ingest::Recording>> openRecording(const RecordingOptions& options) {
  const std::array files{std::filesystem::path(options.file)};
  auto recording = ingest::Recording::open(files, options.clock);
  if (!recording) {
    return std::unexpected(fileError(options.file, recording.error()));
  }
  (*recording)->dataset()->transforms()->setStaticForAllTime(options.static_always);
  (*recording)->load();
  if (const auto added = addRobots(*(*recording)->dataset(), options); !added) {
    return std::unexpected(fileError(options.file, added.error()));
  }
  return std::move(*recording);
}

CliError fileError(const std::string& file, const scenegraph::Status& status) {
  const bool is_named = status.message.find(file) != std::string::npos;
  return {ExitCode::Failure, is_named ? status.message : file + ": " + status.message};
}

std::string printable(std::string_view text) {
  std::string clean;
  while (!text.empty()) {
    const std::size_t length = sequenceLength(text);
    const auto head = static_cast<unsigned char>(text.front());
    if (length == 0 || head < 0x20 || head == 0x7F) {
      clean += '?';
      text.remove_prefix(1);
    } else {
      clean += text.substr(0, length);
      text.remove_prefix(length);
    }
  }
  return clean;
}

}  // namespace stillframe::cli
