#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "tools/cli/commands.h"
#include "tools/cli/effect_arguments.h"
#include "tools/cli/recording_options.h"

namespace {

using namespace stillframe::cli;

int fail(ExitCode code, const std::string& message) {
  std::fflush(stdout);
  std::fprintf(stderr, "stillframe: %s\n", printable(message).c_str());
  return static_cast<int>(code);
}

int run(int argc, char** argv) {
  CLI::App app("Looks at robotics recordings in 3D, exactly as they were at one instant.", "stillframe");
  app.set_version_flag("--version", "stillframe " STILLFRAME_VERSION);
  app.require_subcommand(0, 1);
  std::vector<std::pair<CLI::App*, Command>> commands;
  const auto add = [&](const char* name, const char* what, Command (*make)(CLI::App&)) {
    CLI::App* const command = app.add_subcommand(name, what);
    commands.emplace_back(command, make(*command));
  };
  add("view", "Open recordings in the inspector window", addViewCommand);
  add("render", "Draw one instant to a PNG or EXR file, without a display", addRenderCommand);
  add("pick", "Say what lies at a pixel of what render shows, and measure between two", addPickCommand);
  add("info", "List topics, frames and problems of a recording", addInfoCommand);
  add("tf", "Look up one transform", addTfCommand);
  add("export", "Write what render shows as an OpenSceneGraph file", addExportCommand);
  add("sample", "Write a synthetic recording", addSampleCommand);
  add("bench", "Measure this machine and this build", addBenchCommand);
  add("accuracy", "Measure error against run time", addAccuracyCommand);

  try {
    // CLI11 takes the words last first.
    std::vector<std::string> words = EffectArguments::spelledOut({argv + 1, argv + argc});
    std::ranges::reverse(words);
    app.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
      return app.exit(error);  // --help and --version
    }
    return fail(ExitCode::Usage, error.what());
  }
  for (const auto& [command, start] : commands) {
    if (command->parsed()) {
      const auto done = start();
      return done ? static_cast<int>(ExitCode::Ok) : fail(done.error().code, done.error().message);
    }
  }
  std::fputs(app.help().c_str(), stdout);
  return static_cast<int>(ExitCode::Ok);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {  // what no library of ours throws: out of memory, mostly
    return fail(ExitCode::Failure, error.what());
  }
}
