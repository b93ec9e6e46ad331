#pragma once

#include <expected>
#include <memory>
#include <string>
#include <vector>

#include "scenegraph/status.h"
#include "scenegraph/store/dataset.h"
#include "tools/cli/cli_error.h"
#include "tools/ingest/recording.h"

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11 has it so
class App;
}

namespace stillframe::cli {

/// What every subcommand that reads a recording takes.
struct RecordingOptions {
  std::string file;
  scenegraph::TfClock clock = scenegraph::TfClock::Auto;
  bool static_always = false;
  std::vector<std::string> package_paths;
  std::vector<std::string> robots;
};

/// FILE, and the two options below.
void addRecordingOptions(CLI::App& command, RecordingOptions& options);
/// --tf-time and --static-always.
void addTransformOptions(CLI::App& command, RecordingOptions& options);

/// --package-path and --robot.
void addRobotOptions(CLI::App& command, RecordingOptions& options);
/// Puts what they name into the dataset; after the recording was opened.
[[nodiscard]] std::expected<void, scenegraph::Status> addRobots(scenegraph::Dataset& dataset,
                                                                const RecordingOptions& options);

/// "auto", "header" or "log".
[[nodiscard]] Result<scenegraph::TfClock> parseTfClock(std::string_view text);

/// Opens and loads the whole recording: message indexes and transforms. Blocks.
[[nodiscard]] Result<std::unique_ptr<ingest::Recording>> openRecording(const RecordingOptions& options);

/// The status as a failure of that file: "FILE: message", or the message alone when it names the file itself.
[[nodiscard]] CliError fileError(const std::string& file, const scenegraph::Status& status);

/// Text for one line of a terminal: control characters and what is not UTF-8 replaced by '?'.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace stillframe::cli
