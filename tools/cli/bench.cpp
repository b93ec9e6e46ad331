#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <expected>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <thread>
#include <utility>

#include "generated/stillframe_cli/commit.h"
#include "scenegraph/export/replace_file.h"
#include "scenegraph/pick/scene_pick.h"
#include "scenegraph/pipeline/offscreen_renderer.h"
#include "tools/accuracy/accuracy.h"
#include "tools/cli/bench_results.h"
#include "tools/cli/commands.h"
#include "tools/cli/json_text.h"
#include "tools/cli/scene_session.h"
#include "tools/cli/temporary_sample.h"
#include "tools/sample/sample.h"

namespace stillframe::cli {
namespace {

struct BenchOptions {
  RecordingOptions recording;
  std::vector<std::string> only;
  std::vector<std::string> table;
  std::string svg;
  bool is_open = false;
  bool is_scrub = false;
  bool is_json = false;
};

/// What the numbers were taken on.
struct Machine {
  std::string processor;
  unsigned cores = 1;
  std::string renderer;  ///< "" when no picture was drawn
  double memcpy_mb_per_s = 0.0;
  std::string version;
};

/// Cases that need no recording, by the name that --only takes.
constexpr std::array kGroups{
    std::pair("clouds", &benchClouds),     std::pair("codecs", &benchCodecs),
    std::pair("grids", &benchGrids),       std::pair("markers", &benchMarkers),
    std::pair("robot", &benchRobot),       std::pair("voxels", &benchVoxels),
    std::pair("poses", &benchPoses),       std::pair("sensors", &benchSensors),
    std::pair("points", &benchPoints),     std::pair("ticks", &benchTicks),
    std::pair("messages", &benchMessages), std::pair("transforms", &benchTransforms),
};
// Cases of a recording.
constexpr const char* kRecording = "recording";
constexpr const char* kViews = "views";

std::string processorName() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    if (line.starts_with("model name")) {
      return line.substr(std::min(line.size(), line.find(':') + 2));
    }
  }
  return "unknown processor";
}

void addDistribution(std::vector<BenchResult>& results, const std::string& name, std::vector<double> values_ms,
                     std::optional<double> middle_at_most = {}) {
  std::ranges::sort(values_ms);
  results.push_back({name + ", median", quantile(values_ms, 0.5), "ms", middle_at_most});
  results.push_back({name + ", 95 %", quantile(values_ms, 0.95), "ms"});
  results.push_back({name + ", longest", values_ms.back(), "ms"});
}

/// Ticks at random times, each complete: decoded, converted and posed, not drawn.
std::vector<double> scrub(SceneSession& session, const std::vector<tf::TimePoint>& times) {
  std::vector<double> ticks_ms;
  for (const tf::TimePoint time : times) {
    ticks_ms.push_back(1e3 * secondsOf([&] { session.showTime(time); }));
  }
  return ticks_ms;
}

Result<void> benchRecording(const RecordingOptions& recording, std::vector<BenchResult>& results,
                            std::string& renderer_name) {
  ViewOptions options;
  options.recording = recording;
  std::unique_ptr<SceneSession> session;
  std::unique_ptr<scenegraph::OffscreenRenderer> renderer;
  Result<void> done;
  std::vector<double> frames_ms;
  const auto draw = [&]() -> Result<void> {
    const scenegraph::RenderOptions picture{options.size.width_px, options.size.height_px, options.background};
    const auto drawn = renderer->render(session->scene().root(), session->camera(), picture);
    if (!drawn) {
      return std::unexpected(fileError(recording.file, drawn.error()));
    }
    frames_ms.push_back(renderer->lastFrame().frame_ms);
    return {};
  };
  const double opened_s = secondsOf([&] {
    auto made = SceneSession::make(options);
    if (!made) {
      done = std::unexpected(made.error());
      return;
    }
    session = std::move(*made);
  });
  if (!done) {
    return done;
  }
  const double first_s = secondsOf([&] {
    auto created = scenegraph::OffscreenRenderer::create();
    if (!created) {
      done = std::unexpected(fileError(recording.file, created.error()));
      return;
    }
    renderer = std::move(*created);
    session->setContext(renderer->context().info());
    done = draw();
  });
  if (!done) {
    return done;
  }
  results.push_back({"open, load and first tick", opened_s * 1e3, "ms"});
  results.push_back({"first picture after that, 1280 x 720", first_s * 1e3, "ms"});
  renderer_name = renderer->context().info().renderer;
  frames_ms.clear();
  for (int frame = 0; frame < 15 && done; ++frame) {
    done = draw();
  }
  if (!done) {
    return done;
  }
  addDistribution(results, "frame, 1280 x 720", frames_ms);

  std::mt19937_64 random(7);
  const auto pick = [&] {
    const auto x = static_cast<int>(random() % static_cast<unsigned>(options.size.width_px));
    const auto y = static_cast<int>(random() % static_cast<unsigned>(options.size.height_px));
    (void)scenegraph::describeHits(session->scene(), renderer->pick(x, y));
  };
  results.push_back({"first pick, which makes its shaders", 1e3 * secondsOf(pick), "ms"});
  std::vector<double> picks_ms;
  for (int i = 0; i < 200; ++i) {
    picks_ms.push_back(1e3 * secondsOf(pick));
  }
  addDistribution(results, "pick at a random pixel", picks_ms, 5.0);

  const auto range = *session->scene().dataset().timeRange();
  std::vector<tf::TimePoint> times;
  for (int i = 0; i < 100; ++i) {
    const double place = static_cast<double>(random() >> 11U) * 0x1.0p-53;
    const double span_ns = tf::secondsBetween(range.first, range.second) * 1e9;
    times.push_back(std::min(range.second, tf::TimePoint{range.first.ns + static_cast<std::int64_t>(place * span_ns)}));
  }
  addDistribution(results, "scrub to a random time, first visit", scrub(*session, times));
  addDistribution(results, "scrub to a random time, cached", scrub(*session, times), 16.6);
  return {};
}

double memcpyMbPerS() {
  std::vector<char> from(std::size_t{64} << 20, 'x');
  std::vector<char> to(from.size());
  return static_cast<double>(from.size()) * 1e-6 /
         bestSecondsOf(5, [&] { std::memcpy(to.data(), from.data(), from.size()); });
}

void print(const std::vector<BenchResult>& results, const Machine& machine) {
  std::printf("%s, %u cores, memcpy %.0f MB/s; renderer: %s; stillframe %s\n", machine.processor.c_str(), machine.cores,
              machine.memcpy_mb_per_s, machine.renderer.empty() ? "none" : machine.renderer.c_str(),
              machine.version.c_str());
  for (const BenchResult& result : results) {
    std::printf("  %-60s %12s %-12s", result.name.c_str(), valueText(result.value).c_str(), result.unit.c_str());
    if (result.at_most) {
      std::printf(" %s (at most %g)", result.value <= *result.at_most ? "ok" : "MISSED", *result.at_most);
    } else if (result.at_least) {
      std::printf(" %s (at least %g)", result.value >= *result.at_least ? "ok" : "MISSED", *result.at_least);
    }
    std::printf("\n");
  }
}

Json toJson(const std::vector<BenchResult>& results, const Machine& machine) {
  Json json{
      {"processor", machine.processor}, {"cores", machine.cores},     {"memcpy_mb_per_s", machine.memcpy_mb_per_s},
      {"renderer", machine.renderer},   {"version", machine.version}, {"date", accuracy::dateOfToday()},
      {"results", Json::array()}};
  for (const BenchResult& result : results) {
    Json row{{"name", result.name}, {"value", result.value}, {"unit", result.unit}};
    if (result.at_most) {
      row["at_most"] = *result.at_most;
    }
    if (result.at_least) {
      row["at_least"] = *result.at_least;
    }
    json["results"].push_back(std::move(row));
  }
  return json;
}

/// Of the file, or of a sample made for it.
Result<void> benchFile(RecordingOptions recording, bool with_recording, bool with_views,
                       std::vector<BenchResult>& results, std::string& renderer) {
  const TemporarySample sample;
  if (recording.file.empty()) {
    recording.file = sample.path().string();
    std::optional<CliError> failed;
    const double made_s = secondsOf([&] {
      if (const auto report = sample::writeSample(sample.path(), {}); !report) {
        failed = fileError(recording.file, report.error());
      }
    });
    if (failed) {
      return std::unexpected(*failed);
    }
    results.push_back({"sample recording of 10 s, made", made_s * 1e3, "ms", 2000.0});
  }
  if (with_recording) {
    if (const auto done = benchRecording(recording, results, renderer); !done) {
      return done;
    }
  }
  return with_views ? benchViews(recording, results) : Result<void>{};
}

Result<void> runBench(const BenchOptions& options) {
  if (!options.table.empty()) {
    const auto table = benchTable(options.table);
    if (!table) {
      return std::unexpected(table.error());
    }
    std::fputs(table->c_str(), stdout);
    return {};
  }
  if (!options.svg.empty() &&
      (options.is_scrub || options.is_open ||
       (!options.only.empty() && std::ranges::find(options.only, kViews) == options.only.end()))) {
    return usageError("--svg draws the curves of several views: measure them, with --only views");
  }
  const auto isChosen = [&](const char* name) {
    return !options.is_scrub && !options.is_open &&
           (options.only.empty() || std::ranges::find(options.only, name) != options.only.end());
  };
  std::vector<BenchResult> results;
  Machine machine{.processor = processorName(),
                  .cores = std::thread::hardware_concurrency(),
                  .renderer = "",
                  .memcpy_mb_per_s = memcpyMbPerS(),
                  .version = STILLFRAME_VERSION " (" STILLFRAME_COMMIT ")"};
  if ((options.is_scrub || options.is_open) && options.recording.file.empty()) {
    return usageError("--open and --scrub open a recording: name one");
  }
  if (options.is_open) {
    if (const auto done = benchOpen(options.recording, results); !done) {
      return done;
    }
  }
  if (options.is_scrub) {
    if (const auto done = benchScrub(options.recording, results); !done) {
      return done;
    }
  } else if (isChosen(kRecording) || isChosen(kViews)) {
    if (const auto done =
            benchFile(options.recording, isChosen(kRecording), isChosen(kViews), results, machine.renderer);
        !done) {
      return done;
    }
  }
  if (machine.renderer.empty()) {
    if (const auto renderer = scenegraph::OffscreenRenderer::create()) {
      machine.renderer = (*renderer)->context().info().renderer;
    }
  }
  for (const auto& [name, measure] : kGroups) {
    if (isChosen(name)) {
      measure(results);
    }
  }
  if (!options.svg.empty()) {
    const auto written = scenegraph::replaceFile(
        options.svg, [&](const std::filesystem::path& path) -> std::expected<void, std::string> {
          std::ofstream file(path);
          file << viewsPlot(results, machine.processor + ", " + std::to_string(machine.cores) + " cores, " +
                                         machine.renderer + ", " + accuracy::dateOfToday())
               << std::flush;
          return file ? std::expected<void, std::string>{} : std::unexpected(scenegraph::lastSystemError());
        });
    if (!written) {
      return std::unexpected(fileError(options.svg, written.error()));
    }
  }
  if (options.is_json) {
    std::fputs(jsonText(toJson(results, machine)).c_str(), stdout);
  } else {
    print(results, machine);
  }
  return {};
}

}  // namespace

Command addBenchCommand(CLI::App& app) {
  auto options = std::make_shared<BenchOptions>();
  app.add_option("FILE", options->recording.file, "The recording to measure with; default: the sample recording");
  addTransformOptions(app, options->recording);
  std::vector<std::string> names{kRecording, kViews};
  for (const auto& [name, measure] : kGroups) {
    names.emplace_back(name);
  }
  app.add_option("--only", options->only, "Measure just these; may be repeated")
      ->check(CLI::IsMember(names))
      ->allow_extra_args(false);
  app.add_flag("--open", options->is_open, "Open FILE again and again, beside reading what its first picture needs");
  app.add_flag("--scrub", options->is_scrub, "Drag the slider of FILE there and back");
  app.add_option("--svg", options->svg, "Draw memory and time over the number of views into this file");
  app.add_flag("--json", options->is_json, "One JSON object instead of a table");
  app.add_option("--table", options->table,
                 "Measure nothing: print these files, written with --json, as a Markdown table");
  return [options] { return runBench(*options); };
}

}  // namespace stillframe::cli
