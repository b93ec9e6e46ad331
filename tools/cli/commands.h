#pragma once

#include <functional>

#include "tools/cli/cli_error.h"

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11 has it so
class App;
}

namespace stillframe::cli {

/// Runs a subcommand after the command line was read.
using Command = std::function<Result<void>()>;

// One per subcommand, in its own file: declares its options on `app` and returns what to run. The returned command
// holds the options; `app` refers to them, so both must live until the command has run.
[[nodiscard]] Command addInfoCommand(CLI::App& app);
[[nodiscard]] Command addTfCommand(CLI::App& app);
[[nodiscard]] Command addRenderCommand(CLI::App& app);
[[nodiscard]] Command addPickCommand(CLI::App& app);
[[nodiscard]] Command addExportCommand(CLI::App& app);
[[nodiscard]] Command addSampleCommand(CLI::App& app);
[[nodiscard]] Command addBenchCommand(CLI::App& app);
[[nodiscard]] Command addAccuracyCommand(CLI::App& app);
[[nodiscard]] Command addViewCommand(CLI::App& app);

}  // namespace stillframe::cli
