#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "scenegraph/export/picture_io.h"
#include "scenegraph/export/picture_normals.h"
#include "scenegraph/pipeline/offscreen_renderer.h"
#include "tools/cli/commands.h"
#include "tools/cli/effect_arguments.h"
#include "tools/cli/layer_ids.h"
#include "tools/cli/layer_report.h"
#include "tools/cli/scene_session.h"

namespace stillframe::cli {
namespace {

struct RenderCommandOptions {
  explicit RenderCommandOptions(CLI::App& app) : view(app), effects(app) {}
  ViewArguments view;
  EffectArguments effects;
  std::string out;
  std::string channels;
  bool is_json = false;
};

struct Channels {
  bool normals = false;
  bool ids = false;
};

Result<Channels> parseChannels(const std::string& text, bool is_exr) {
  Channels channels;
  if (!text.empty() && !is_exr) {
    return usageError("--channels '" + text + "': only an .exr has channels besides its colours");
  }
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string name = text.substr(begin, end - begin);
    if (name != "normals" && name != "id") {
      return usageError("--channels '" + name + "' is none of normals, id");
    }
    (name == "id" ? channels.ids : channels.normals) = true;
    begin = end + 1;
  }
  return channels;
}

/// The effects that are on, with their settings.
Json effectsJson(const scenegraph::ViewEffects& effects) {
  Json json = Json::object();
  for (const auto& type : scenegraph::effectTypes()) {
    if (effects.isOn(type.name)) {
      json[std::string(type.name)] = effects.settings(type.name);
    }
  }
  return json;
}

/// Who drew the opaque points; where that was not OpenGL by itself, how many there are and in what time.
Json pointsJson(const scenegraph::FrameStatistics& frame) {
  if (!frame.points) {
    return {{"rasterizer", "gl"}};
  }
  return {{"rasterizer", frame.points->by},       {"count", frame.points->points},
          {"in_view", frame.points->in_view},     {"share", frame.points->share},
          {"raster_ms", frame.points->raster_ms}, {"resolve_ms", frame.points->resolve_ms}};
}

Result<void> runRender(const RenderCommandOptions& options) {
  const std::filesystem::path out = options.out;
  if (out.extension() != ".png" && out.extension() != ".exr") {
    return usageError(options.out + ": the name of a picture ends in .png or .exr");
  }
  const auto view = options.view.view();
  if (!view) {
    return std::unexpected(view.error());
  }
  const auto effects = options.effects.effects();
  if (!effects) {
    return std::unexpected(effects.error());
  }
  const bool is_exr = out.extension() == ".exr";
  const auto channels = parseChannels(options.channels, is_exr);
  if (!channels) {
    return std::unexpected(channels.error());
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
  session.setContext((*renderer)->context().info());
  session.scene().setView(session.camera(),
                          {static_cast<double>(view->size.width_px), static_cast<double>(view->size.height_px)});
  // An .exr is scene-linear, before the tone curve.
  const scenegraph::RenderOptions render_options{view->size.width_px, view->size.height_px, view->background,
                                                 is_exr ? effects->linearChain() : effects->chain(), view->points};
  auto picture = (*renderer)->render(session.scene().root(), session.camera(), render_options);
  if (!picture) {
    return std::unexpected(fileError(options.out, picture.error()));
  }
  const scenegraph::FrameStatistics frame = (*renderer)->lastFrame();
  if (channels->normals) {
    picture->normals = scenegraph::normalsOf(*picture, session.camera());
  }
  if (channels->ids) {
    if (const auto added = addLayerIds(**renderer, session, render_options, *picture); !added) {
      return std::unexpected(fileError(options.out, added.error()));
    }
  }
  const auto written = is_exr ? scenegraph::writeExr(*picture, out) : scenegraph::writePng(*picture, out);
  if (!written) {
    return std::unexpected(fileError(options.out, written.error()));
  }
  const auto& dataset = session.scene().dataset();
  if (options.is_json) {
    const Json json{{"size", {view->size.width_px, view->size.height_px}},
                    {"time_ns", session.time().ns},
                    {"fixed_frame", session.scene().fixedFrame()},
                    {"frame_ms", frame.frame_ms},
                    {"passes", frame.passes},
                    {"effects", effectsJson(*effects)},
                    {"samples", frame.samples},
                    {"points", pointsJson(frame)},
                    {"layers", layersJson(session.scene())},
                    {"renderer", (*renderer)->context().info().renderer},
                    {"problems", problemsJson(dataset.problems())}};
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
  app.add_option(
         "--channels", options->channels,
         "normals,id: of an .exr, besides R, G, B, A and Z: N.X, N.Y, N.Z in the fixed frame; the layer's number")
      ->type_name("NAMES");
  app.add_flag("--json", options->is_json, "One JSON object on what was drawn");
  return [options] { return runRender(*options); };
}

}  // namespace stillframe::cli
