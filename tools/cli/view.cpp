#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/cli/commands.h"
#include "tools/cli/effect_arguments.h"
#include "tools/cli/layer_argument.h"
#include "tools/cli/layout_argument.h"
#include "tools/cli/recording_options.h"
#include "tools/cli/time_argument.h"
#include "tools/cli/view_options.h"
#ifdef STILLFRAME_HAS_VIEWER
#include "tools/ingest/file.h"
#include "viewer/window/inspector.h"
#endif

namespace stillframe::cli {
namespace {

constexpr int kMostViews = 9;
constexpr double kLeastBudgetMs = 1.0;
constexpr double kMostBudgetMs = 1000.0;

struct ViewCommandOptions {
  explicit ViewCommandOptions(CLI::App& app) : effects(app) {}
  EffectArguments effects;
  std::vector<std::string> files;
  RecordingOptions recording;  // its clock and switch; the files are above
  int views = 1;
  std::string time;
  std::string fixed_frame;
  std::vector<std::string> layers;
  bool only_named_layers = false;
  std::string camera;
  std::string follow;
  std::string points = "auto";
  std::optional<double> point_budget_ms;
  std::string layout;
  std::string screenshot;
  std::string theme;
  std::string compose = "auto";
  bool reports_stalls = false;
};

#ifdef STILLFRAME_HAS_VIEWER

bool isSet(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

/// Refuses what can be told to be no recording before a window opens; the rest is read while the window is there.
Result<void> checkFile(const std::string& path) {
  const auto file = ingest::File::open(path);
  if (!file) {
    return std::unexpected(fileError(path, file.error()));
  }
  constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
  std::array<std::byte, kMagic.size()> head{};
  const std::size_t got = (*file)->read(0, head);
  if (got != head.size() || std::string_view(reinterpret_cast<const char*>(head.data()), head.size()) != kMagic) {
    return failure(path + ": not an MCAP file" + (got == 0 ? ": it is empty" : ""));
  }
  return {};
}

/// What the inspector calls on a worker thread for each recording it opens.
viewer::RecordingOpener makeOpener(const RecordingOptions& options) {
  return [options](const std::vector<std::filesystem::path>& files)
             -> std::expected<viewer::OpenedRecording, scenegraph::Status> {
    auto opened = ingest::Recording::open(files, options.clock);
    if (!opened) {
      return std::unexpected(opened.error());
    }
    const std::shared_ptr<ingest::Recording> recording = std::move(*opened);
    recording->dataset()->transforms()->setStaticForAllTime(options.static_always);
    if (auto added = addRobots(*recording->dataset(), options); !added) {
      return std::unexpected(added.error());
    }
    return viewer::OpenedRecording{
        recording->dataset(), [recording](const std::function<bool(double)>& progress) { recording->load(progress); }};
  };
}

Result<void> runView(const ViewCommandOptions& options) {
  if (const auto time = parseTime(options.time.empty() ? "start" : options.time); !time) {
    return std::unexpected(time.error());
  }
  viewer::InspectorOptions inspector;
  for (const std::string& text : options.layers) {
    auto layer = parseLayer(text);
    if (!layer) {
      return std::unexpected(layer.error());
    }
    inspector.layers.layers.push_back({std::move(layer->id), std::move(layer->settings)});
  }
  for (const std::string& file : options.files) {
    if (const auto checked = checkFile(file); !checked) {
      return checked;
    }
    inspector.files.emplace_back(file);
  }
  if (!options.layout.empty()) {
    auto layout = readLayoutFile(options.layout);
    if (!layout) {
      return std::unexpected(layout.error());
    }
    inspector.layout = std::move(*layout);
    inspector.layout_file = options.layout;
  }
  if (!isSet("DISPLAY") && !isSet("WAYLAND_DISPLAY") && !isSet("QT_QPA_PLATFORM")) {
    return failure(
        "view needs a display, and neither DISPLAY nor WAYLAND_DISPLAY is set; 'stillframe render FILE --out "
        "picture.png' needs none");
  }
  if (!options.camera.empty()) {
    const auto camera = parseCamera(options.camera);
    if (!camera) {
      return std::unexpected(camera.error());
    }
    inspector.camera = *camera;
  }
  if (!options.follow.empty()) {
    auto follow = parseFollow(options.follow);
    if (!follow) {
      return std::unexpected(follow.error());
    }
    inspector.display_frame = std::move(follow->first);
    inspector.follow = follow->second;
  }
  const auto points = parsePointWay(options.points);
  if (!points) {
    return std::unexpected(points.error());
  }
  inspector.points = *points;
  inspector.point_budget_ms = options.point_budget_ms;
  auto effects = options.effects.effects();
  if (!effects) {
    return std::unexpected(effects.error());
  }
  inspector.effects = std::move(*effects);
  if (inspector.layout) {
    for (scenegraph::ViewLayout* const view : scenegraph::viewsOf(*inspector.layout)) {
      view->effects = options.effects.effects(effectsOf(*view))->toTexts();  // over what the layout says
    }
  }
  if (!options.theme.empty()) {
    inspector.theme = viewer::themeOf(options.theme);
  }
  inspector.way = options.compose == "image"    ? viewer::ViewWay::Image
                  : options.compose == "opengl" ? viewer::ViewWay::Composed
                                                : viewer::ViewWay::Auto;
  inspector.reports_stalls = options.reports_stalls;
  inspector.layers.only = options.only_named_layers;
  if (!options.time.empty()) {
    inspector.time = options.time;
  }
  inspector.views = options.views;
  if (!options.fixed_frame.empty()) {
    inspector.fixed_frame = options.fixed_frame;
  }
  if (!options.screenshot.empty()) {
    inspector.screenshot = options.screenshot;
  }
  std::string name = "stillframe";
  std::array<char*, 2> arguments{name.data(), nullptr};
  const auto code = viewer::runInspector(1, arguments.data(), inspector, makeOpener(options.recording));
  if (!code) {
    return failure(code.error().message);
  }
  return *code == 0 ? Result<void>{} : failure("the inspector ended with code " + std::to_string(*code));
}

#else

Result<void> runView(const ViewCommandOptions&) {
  return failure("this build has no inspector window; 'stillframe render FILE --out picture.png' needs none");
}

#endif

}  // namespace

Command addViewCommand(CLI::App& app) {
  auto options = std::make_shared<ViewCommandOptions>(app);
  app.add_option("FILE", options->files, "Recordings: the parts of a split one; none: a window that waits for a drop");
  addTransformOptions(app, options->recording);
  addRobotOptions(app, options->recording);
  CLI::Option* const views = app.add_option("--views", options->views, "Views, in rows and columns")
                                 ->check(CLI::Range(1, kMostViews))
                                 ->capture_default_str();
  app.add_option(
      "--time", options->time,
      "Nanoseconds, +SECONDS from the start, start, or end; default: the first moment with something to see");
  app.add_option("--fixed-frame", options->fixed_frame, "Frame that stands still; default: map, world, odom, ...");
  app.add_option("--camera", options->camera, "orbit, xyorbit, topdown (from above, without perspective) or fly")
      ->type_name("MODEL");
  app.add_option("--layout", options->layout, "A saved layout (.xml): views, frames, cameras, effects and layers")
      ->type_name("FILE")
      ->excludes(views);
  app.add_option("--follow", options->follow, "FRAME[:position|heading|pose]: the camera goes along with this frame")
      ->type_name("FRAME[:MODE]");
  app.add_option("--points", options->points, kPointsHelp)->type_name("WHO")->capture_default_str();
  app.add_option(
         "--point-budget", options->point_budget_ms,
         "Milliseconds of a frame for points; what they do not suffice for comes with the next frames. Default: 33 "
         "where OpenGL is software, else 12")
      ->type_name("MS")
      ->check([](const std::string& text) {  // a range takes what is no number for one
        return std::isfinite(std::strtod(text.c_str(), nullptr)) ? std::string() : "'" + text + "' is no number";
      })
      ->check(CLI::Range(kLeastBudgetMs, kMostBudgetMs));
  app.add_option("--layer", options->layers, "TOPIC[:key=value,...]: settings of a layer; may be repeated")
      ->type_name("LAYER")
      ->allow_extra_args(false);
  app.add_flag("--only", options->only_named_layers, "Draw just the layers named by --layer");
  app.add_option("--screenshot", options->screenshot, "Save a PNG of the window when all is loaded, and quit");
  app.add_option("--theme", options->theme, "Colours of the window: system, light or dark; default: as chosen last")
      ->check(CLI::IsMember({"system", "light", "dark"}));
  app.add_option("--compose", options->compose,
                 "What brings views to the screen: opengl, with all of the window, or image, each read back and "
                 "painted; auto: image where OpenGL is software")
      ->check(CLI::IsMember({"auto", "opengl", "image"}))
      ->capture_default_str();
  app.add_flag("--stalls", options->reports_stalls,
               "When the window closes, say what has kept it from answering, for how long");
  return [options] { return runView(*options); };
}

}  // namespace stillframe::cli
