#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "scenegraph/export/osgt_export.h"
#include "tools/cli/commands.h"
#include "tools/cli/layer_report.h"
#include "tools/cli/scene_session.h"

namespace stillframe::cli {
namespace {

struct ExportCommandOptions {
  explicit ExportCommandOptions(CLI::App& app) : view(app) {}
  ViewArguments view;
  std::string out;
};

Result<void> runExport(const ExportCommandOptions& options) {
  const std::filesystem::path out = options.out;
  if (out.extension() != ".osgt" && out.extension() != ".osgb") {
    return usageError(options.out + ": the name of an export ends in .osgt or .osgb");
  }
  const auto view = options.view.view();
  if (!view) {
    return std::unexpected(view.error());
  }
  auto made = SceneSession::make(*view);
  if (!made) {
    return std::unexpected(made.error());
  }
  SceneSession& session = **made;
  if (const auto written = scenegraph::exportGraph(session.scene().root(), session.exportInfo(), out); !written) {
    return std::unexpected(fileError(options.out, written.error()));
  }
  std::printf("%s: %lld ns, fixed frame '%s'\n", printable(options.out).c_str(),
              static_cast<long long>(session.time().ns), printable(session.scene().fixedFrame()).c_str());
  printLines("layout", session.layoutNotes());
  printRemarks(session.scene(), session.scene().dataset());
  return {};
}

}  // namespace

Command addExportCommand(CLI::App& app) {
  auto options = std::make_shared<ExportCommandOptions>(app);
  app.add_option("--out", options->out, "The file: .osgt (text, 17 digits) or .osgb (binary)")->required();
  return [options] { return runExport(*options); };
}

}  // namespace stillframe::cli
