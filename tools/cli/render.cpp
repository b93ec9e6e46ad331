#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <memory>
#include <numbers>

#include "nodes/legend/picture_overlay.h"
#include "scenegraph/export/picture_io.h"
#include "scenegraph/export/picture_normals.h"
#include "scenegraph/pick/place_picks.h"
#include "scenegraph/pipeline/offscreen_renderer.h"
#include "tools/cli/commands.h"
#include "tools/cli/effect_arguments.h"
#include "tools/cli/layer_ids.h"
#include "tools/cli/layer_report.h"
#include "tools/cli/picture_sequence.h"
#include "tools/cli/scene_session.h"

namespace stillframe::cli {
namespace {

struct RenderCommandOptions {
  explicit RenderCommandOptions(CLI::App& app) : view(app), effects(app) {}
  ViewArguments view;
  EffectArguments effects;
  std::string out;
  std::string channels;
  std::string times;
  std::string turntable;
  bool is_json = false;
  bool has_legend = false;
  bool has_no_legend = false;
  bool has_no_picks = false;
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

/// One picture of a run.
struct Shot {
  tf::TimePoint time;
  double turn_rad = 0.0;
  std::string file;
};

/// What all pictures of a run have in common.
struct Run {
  ViewOptions view;
  scenegraph::ViewEffects effects;
  Channels channels;
  bool is_exr = false;
  bool has_legend = false;
  scenegraph::PickMarks picks;
};

volatile std::sig_atomic_t is_interrupted = 0;

/// From now on the first Ctrl+C ends the run after the picture that is being made, the second at once.
void finishOnInterrupt() {
  for (const int signal : {SIGINT, SIGTERM}) {
    std::signal(signal, [](int received) {
      is_interrupted = 1;
      std::signal(received, SIG_DFL);
    });
  }
}

Result<std::vector<Shot>> planShots(const RenderCommandOptions& options, const SceneSession& session,
                                    const scenegraph::Dataset& dataset) {
  if (options.times.empty() && options.turntable.empty()) {
    return std::vector<Shot>{{session.time(), 0.0, options.out}};
  }
  std::vector<Shot> shots;
  if (!options.times.empty()) {
    const auto asked = parseTimes(options.times);
    if (!asked) {
      return std::unexpected(asked.error());
    }
    const auto times = resolveTimes(*asked, *dataset.timeRange());
    if (!times) {
      return std::unexpected(times.error());
    }
    for (const tf::TimePoint time : *times) {
      shots.push_back({time, 0.0, {}});
    }
  } else {
    const auto count = parseNumber("--turntable", options.turntable, 1, kMostPictures);
    if (!count || *count != std::floor(*count)) {
      return usageError("--turntable '" + options.turntable + "' is not a whole number of pictures from 1 to " +
                        std::to_string(kMostPictures));
    }
    for (double i = 0.0; i < *count; ++i) {
      shots.push_back({session.time(), 2.0 * std::numbers::pi * i / *count, {}});
    }
  }
  const auto name = NumberedName::parse(options.out);
  if (!name) {
    return std::unexpected(name.error());
  }
  for (std::size_t i = 0; i < shots.size(); ++i) {
    shots[i].file = name->at(static_cast<int>(i));
  }
  return shots;
}

/// Draws and writes one picture; says how long the drawing took.
Result<scenegraph::FrameStatistics> takeShot(const Run& run, const Shot& shot, SceneSession& session,
                                             scenegraph::OffscreenRenderer& renderer) {
  if (shot.time != session.time()) {
    session.showTime(shot.time);
  }
  const scenegraph::CameraView camera = session.camera(shot.turn_rad);
  const scenegraph::PictureSize size{static_cast<double>(run.view.size.width_px),
                                     static_cast<double>(run.view.size.height_px)};
  session.scene().setView(camera, size);
  // An .exr is scene-linear, before the tone curve.
  const scenegraph::RenderOptions options{run.view.size.width_px, run.view.size.height_px, run.view.background,
                                          run.is_exr ? run.effects.linearChain() : run.effects.chain(),
                                          run.view.points};
  auto picture = renderer.render(session.scene().root(), camera, options);
  if (!picture) {
    return std::unexpected(fileError(shot.file, picture.error()));
  }
  const scenegraph::FrameStatistics frame = renderer.lastFrame();
  if (run.channels.normals) {
    picture->normals = scenegraph::normalsOf(*picture, camera);
  }
  if (run.channels.ids) {
    if (const auto added = addLayerIds(renderer, session, camera, options, *picture); !added) {
      return std::unexpected(fileError(shot.file, added.error()));
    }
  }
  nodes::PictureOverlay overlay(picture->rgba, picture->width, picture->height, nodes::overlayScale(picture->height));
  overlay.addPicks(scenegraph::placePicks(session.scene(), camera, size, run.picks));
  if (run.has_legend) {
    overlay.addLegends(nodes::legendEntries(session.scene()));
  }
  const auto written =
      run.is_exr ? scenegraph::writeExr(*picture, shot.file) : scenegraph::writePng(*picture, shot.file);
  if (!written) {
    return std::unexpected(fileError(shot.file, written.error()));
  }
  return frame;
}

/// The lengths that the layout keeps, as they are now; null where an end has no place.
Json measurementsJson(const Run& run, const scenegraph::Scene& scene) {
  Json json = Json::array();
  for (const auto& pair : run.picks.measured) {
    const auto measured = scenegraph::measureNow(scene, pair);
    json.push_back(
        measured ? Json{{"length_m", measured->length_m},
                        {"delta", {measured->delta_in_fixed.x, measured->delta_in_fixed.y, measured->delta_in_fixed.z}}}
                 : Json(nullptr));
  }
  return json;
}

/// The whole answer for one picture; for several, what they share, to which "pictures" is added.
Json runJson(const Run& run, SceneSession& session, scenegraph::OffscreenRenderer& renderer) {
  const scenegraph::FrameStatistics& frame = renderer.lastFrame();
  return {{"size", {run.view.size.width_px, run.view.size.height_px}},
          {"time_ns", session.time().ns},
          {"fixed_frame", session.scene().fixedFrame()},
          {"frame_ms", frame.frame_ms},
          {"passes", frame.passes},
          {"effects", effectsJson(run.effects)},
          {"samples", frame.samples},
          {"points", pointsJson(frame)},
          {"layers", layersJson(session.scene())},
          {"measurements", measurementsJson(run, session.scene())},
          {"renderer", renderer.context().info().renderer},
          {"layout_notes", session.layoutNotes()},
          {"problems", problemsJson(session.scene().dataset().problems())}};
}

Result<Run> prepare(const RenderCommandOptions& options) {
  const std::filesystem::path out = options.out;
  if (out.extension() != ".png" && out.extension() != ".exr") {
    return usageError(options.out + ": the name of a picture ends in .png or .exr");
  }
  if (options.has_legend && out.extension() == ".exr") {
    return usageError("--legend: a legend is drawn into a .png; an .exr holds the scene alone");
  }
  auto view = options.view.view();
  if (!view) {
    return std::unexpected(view.error());
  }
  if (!options.times.empty()) {
    const auto times = parseTimes(options.times);
    if (!times) {
      return std::unexpected(times.error());
    }
    view->time = times->first;
  }
  auto effects = options.effects.effects(effectsOf(view->layout));
  if (!effects) {
    return std::unexpected(effects.error());
  }
  const bool is_exr = out.extension() == ".exr";
  const auto channels = parseChannels(options.channels, is_exr);
  if (!channels) {
    return std::unexpected(channels.error());
  }
  // An .exr is the scene alone. A layout's picture is the window's, unless something else is said.
  const auto& layout = view->layout;
  const bool has_legend = options.has_legend || (layout && layout->shows_legend && !options.has_no_legend);
  const scenegraph::PickMarks picks =
      layout && !options.has_no_picks && !is_exr ? layout->picks : scenegraph::PickMarks{};
  return Run{.view = *view,
             .effects = std::move(*effects),
             .channels = *channels,
             .is_exr = is_exr,
             .has_legend = has_legend && !is_exr,
             .picks = picks};
}

Result<void> runRender(const RenderCommandOptions& options) {
  const auto run = prepare(options);
  if (!run) {
    return std::unexpected(run.error());
  }
  const bool is_sequence = !options.times.empty() || !options.turntable.empty();
  if (is_sequence) {
    finishOnInterrupt();
  }
  auto made = SceneSession::make(run->view);
  if (!made) {
    return std::unexpected(made.error());
  }
  SceneSession& session = **made;
  const auto shots = planShots(options, session, session.scene().dataset());
  if (!shots) {
    return std::unexpected(shots.error());
  }
  auto renderer = scenegraph::OffscreenRenderer::create();
  if (!renderer) {
    return std::unexpected(fileError(options.out, renderer.error()));
  }
  session.setContext((*renderer)->context().info());
  Json pictures = Json::array();
  std::size_t taken = 0;
  for (; taken < shots->size() && is_interrupted == 0; ++taken) {
    const Shot& shot = (*shots)[taken];
    const auto frame = takeShot(*run, shot, session, **renderer);
    if (!frame) {
      return std::unexpected(frame.error());
    }
    if (!options.is_json) {
      std::printf("%s: %d x %d at %lld ns, fixed frame '%s', %.1f ms\n", printable(shot.file).c_str(),
                  run->view.size.width_px, run->view.size.height_px, static_cast<long long>(shot.time.ns),
                  printable(session.scene().fixedFrame()).c_str(), frame->frame_ms);
    } else if (is_sequence) {
      pictures.push_back({{"file", shot.file},
                          {"time_ns", shot.time.ns},
                          {"turn_deg", glm::degrees(shot.turn_rad)},
                          {"frame_ms", frame->frame_ms},
                          {"points", pointsJson(*frame)},
                          {"layers", layersJson(session.scene())},
                          {"measurements", measurementsJson(*run, session.scene())}});
    }
  }
  if (options.is_json) {
    Json json = runJson(*run, session, **renderer);
    if (is_sequence) {
      for (const char* of_one : {"time_ns", "frame_ms", "points", "layers", "measurements"}) {
        json.erase(of_one);
      }
      json["pictures"] = std::move(pictures);
    }
    std::fputs(jsonText(json).c_str(), stdout);
  } else {
    if (run->is_exr && run->effects.chain().passes.size() > run->effects.linearChain().passes.size()) {
      std::puts("  an .exr is scene-linear: without tone mapping, exposure and dithering");
    }
    printLines("layout", session.layoutNotes());
    printRemarks(session.scene(), session.scene().dataset());
  }
  if (taken < shots->size()) {
    return failure("stopped after " + std::to_string(taken) + " of " + std::to_string(shots->size()) + " pictures");
  }
  return {};
}

}  // namespace

Command addRenderCommand(CLI::App& app) {
  auto options = std::make_shared<RenderCommandOptions>(app);
  app.add_option(
         "--out", options->out,
         "The picture: .png (8 bit) or .exr (scene-linear float, with Z); of several, with their number's place: "
         "frame_%05d.png")
      ->required();
  CLI::Option* const times =
      app.add_option("--times", options->times, "Several pictures: from time A to time B, every STEP seconds")
          ->type_name("A:B:STEP")
          ->excludes(app.get_option("--time"));
  app.add_option("--turntable", options->turntable, "Several pictures: once round what is looked at, in N of them")
      ->type_name("N")
      ->excludes(times);
  app.add_option(
         "--channels", options->channels,
         "normals,id: of an .exr, besides R, G, B, A and Z: N.X, N.Y, N.Z in the fixed frame; the layer's number")
      ->type_name("NAMES");
  CLI::Option* const legend =
      app.add_flag("--legend", options->has_legend,
                   "What the colours of values mean, in the picture's corner (.png); default: as --layout says");
  app.add_flag("--no-legend", options->has_no_legend, "Without it, whatever --layout says")->excludes(legend);
  app.add_flag("--no-picks", options->has_no_picks, "Without what --layout keeps as picked and measured");
  app.add_flag("--json", options->is_json, "One JSON object on what was drawn; of several pictures, on each of them");
  return [options] { return runRender(*options); };
}

}  // namespace stillframe::cli
