#include "tools/accuracy/accuracy.h"

#include <cstdio>
#include <memory>
#include <string>

#include "tools/cli/commands.h"

namespace stillframe::cli {
namespace {

struct AccuracyOptions {
  std::string subject = "tf";
  std::string folder;
};

Result<void> runAccuracy(const AccuracyOptions& options) {
  const accuracy::AccuracyReport report = accuracy::tfAccuracy();
  std::fputs(report.table.c_str(), stdout);
  if (options.folder.empty()) {
    return {};
  }
  if (!accuracy::writeReport(report, options.folder)) {
    return failure(options.folder + ": cannot write " + report.name + ".md and " + report.name + ".svg there");
  }
  std::printf("\n%s/%s.md\n%s/%s.svg\n", options.folder.c_str(), report.name.c_str(), options.folder.c_str(),
              report.name.c_str());
  return {};
}

}  // namespace

Command addAccuracyCommand(CLI::App& app) {
  auto options = std::make_shared<AccuracyOptions>();
  app.add_option("SUBJECT", options->subject, "tf: the ways of composing a chain of transforms")
      ->check(CLI::IsMember({"tf"}))
      ->capture_default_str();
  app.add_option("--out", options->folder, "Folder for the table and an SVG plot of error against run time");
  return [options] { return runAccuracy(*options); };
}

}  // namespace stillframe::cli
