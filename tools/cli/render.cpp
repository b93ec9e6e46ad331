#include <cstdio>
#include <filesystem>
#include <memory>

#include "scenegraph/export/picture_io.h"
#include "scenegraph/pipeline/offscreen_renderer.h"
#include "tools/cli/commands.h"
#include "tools/cli/layer_report.h"
#include "tools/cli/scene_session.h"

namespace stillframe::cli {
namespace {

struct RenderCommandOptions {
  explicit RenderCommandOptions(CLI::App& app) : view(app) {}
  ViewArguments view;
  std::string out;
  bool is_json = false;
};

Result<void> runRender(const RenderCommandOptions& options) {
  const std::filesystem::path out = options.out;
  if (out.extension() != ".png" && out.extension() != ".exr") {
    return usageError(options.out + ": the name of a picture ends in .png or .exr");
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
  auto renderer = scenegraph::OffscreenRenderer::create();
  if (!renderer) {
    return std::unexpected(fileError(options.out, renderer.error()));
  }
  const auto picture = (*renderer)->render(session.scene().root(), session.camera(),
                                           {view->size.width_px, view->size.height_px, view->background});
  if (!picture) {
    return std::unexpected(fileError(options.out, picture.error()));
  }
  const auto written =
      out.extension() == ".png" ? scenegraph::writePng(*picture, out) : scenegraph::writeExr(*picture, out);
  if (!written) {
    return std::unexpected(fileError(options.out, written.error()));
  }
  const auto& frame = (*renderer)->lastFrame();
  const auto& dataset = session.scene().dataset();
  if (options.is_json) {
    const Json json{{"size", {view->size.width_px, view->size.height_px}},
                    {"time_ns", session.time().ns},
                    {"fixed_frame", session.scene().fixedFrame()},
                    {"frame_ms", frame.frame_ms},
                    {"passes", frame.passes},
                    {"layers", layersJson(session.scene())},
                    {"renderer", (*renderer)->context().info().renderer},
                    {"problems", problemsJson(dataset)}};
    std::fputs(jsonText(json).c_str(), stdout);
  } else {
    std::printf("%s: %d x %d at %lld ns, fixed frame '%s', %.1f ms\n", printable(options.out).c_str(),
                view->size.width_px, view->size.height_px, static_cast<long long>(session.time().ns),
                printable(session.scene().fixedFrame()).c_str(), frame.frame_ms);
    printRemarks(session.scene(), dataset);
  }
  return {};
}

}  // namespace

Command addRenderCommand(CLI::App& app) {
  auto options = std::make_shared<RenderCommandOptions>(app);
  app.add_option("--out", options->out, "The picture: .png (8 bit) or .exr (scene-linear float, with Z)")->required();
  app.add_flag("--json", options->is_json, "One JSON object on what was drawn");
  return [options] { return runRender(*options); };
}

}  // namespace stillframe::cli
