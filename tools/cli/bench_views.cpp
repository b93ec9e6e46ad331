#include <algorithm>
#include <array>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "nodes/registry.h"
#include "scenegraph/camera/camera_rig.h"
#include "scenegraph/how_many.h"
#include "scenegraph/osg_box.h"
#include "scenegraph/pipeline/offscreen_renderer.h"
#include "scenegraph/scene.h"
#include "tools/accuracy/svg_plot.h"
#include "tools/cli/bench_results.h"
#include "tools/cli/recording_options.h"

namespace stillframe::cli {
namespace {

constexpr int kWidth_px = 640;
constexpr int kHeight_px = 360;
constexpr int kTimes = 20;
constexpr int kDraws = 5;

constexpr std::array<std::size_t, 3> kCounts{1, 2, 4};

std::string viewsName(std::size_t views) { return scenegraph::howMany(views, "views") + ", "; }

/// One view without a widget: what is a view's own.
struct BenchView {
  std::unique_ptr<scenegraph::Scene> scene;
  std::unique_ptr<scenegraph::OffscreenRenderer> renderer;
};

struct ViewCosts {
  double scenes_mib = 0.0;    // the data that is shown, and the scenes, without pictures
  double pictures_mib = 0.0;  // contexts, targets and what a software OpenGL keeps of the data
  double cache_mib = 0.0;     // decoded and converted, kept for all views
  double first_tick_ms = 0.0;
  double tick_ms = 0.0;
  double frame_ms = 0.0;
};

void tick(std::vector<BenchView>& views, tf::TimePoint time) {
  for (BenchView& view : views) {
    do {
      view.scene->update(time);  // the executor is synchronous
    } while (view.scene->isPending());
  }
}

Result<ViewCosts> measure(const RecordingOptions& options, std::size_t count) {
  ViewCosts costs;
  auto opened = openRecording(options);  // anew: nothing is decoded yet
  if (!opened) {
    return std::unexpected(opened.error());
  }
  const auto dataset = (*opened)->dataset();
  const auto range = *dataset->timeRange();
  const auto executor = scenegraph::makeSynchronousExecutor();
  const double before_mib = heapMib();
  std::vector<BenchView> views(count);
  constexpr std::array kFixedFrames = {"map", "odom", "base_link", ""};
  for (std::size_t i = 0; i < count; ++i) {
    views[i].scene = std::make_unique<scenegraph::Scene>(dataset, nodes::layerTypes(), *executor);
    views[i].scene->addDefaultLayers();
    if (const std::string frame = kFixedFrames[i % kFixedFrames.size()]; dataset->transforms()->findFrame(frame)) {
      views[i].scene->setFixedFrame(frame);  // each its own
    }
  }
  std::mt19937_64 random(3);
  std::vector<tf::TimePoint> times;
  for (int i = 0; i < kTimes; ++i) {
    const double place = static_cast<double>(random() >> 11U) * 0x1.0p-53;
    times.push_back(
        {range.first.ns + static_cast<std::int64_t>(place * static_cast<double>(range.second.ns - range.first.ns))});
  }
  const auto scrub = [&] {
    for (const tf::TimePoint time : times) {
      tick(views, time);
    }
  };
  costs.first_tick_ms = 1e3 * secondsOf(scrub) / kTimes;
  costs.tick_ms = 1e3 * bestSecondsOf(3, scrub) / kTimes;
  costs.scenes_mib = heapMib() - before_mib;
  costs.cache_mib = static_cast<double>(dataset->cache().bytes()) / (1024.0 * 1024.0);

  const double before_pictures_mib = heapMib();
  for (BenchView& view : views) {
    auto renderer = scenegraph::OffscreenRenderer::create();
    if (!renderer) {
      return std::unexpected(fileError(options.file, renderer.error()));
    }
    view.renderer = std::move(*renderer);
  }
  const auto draw = [&] {
    for (BenchView& view : views) {
      scenegraph::CameraRig rig;
      rig.change().frame(view.scene->bulkInFixed(), static_cast<double>(kWidth_px) / kHeight_px);
      (void)view.renderer->render(view.scene->root(), rig.view(), {kWidth_px, kHeight_px, {}});
    }
  };
  costs.frame_ms = 1e3 * bestSecondsOf(kDraws, draw);
  costs.pictures_mib = heapMib() - before_pictures_mib;
  return costs;
}

}  // namespace

std::string viewsPlot(const std::vector<BenchResult>& results, const std::string& caption) {
  accuracy::PlotFigure figure{.title = "Several views of one recording",
                              .caption = caption,
                              .x_label = "views",
                              .y_label = "to that of one view",
                              .panels = {{.title = "Memory", .series = {}}, {.title = "Time", .series = {}}}};
  for (const BenchResult& one : results) {
    const std::string head = viewsName(1);
    if (!one.name.starts_with(head) || !(one.value > 0.0)) {
      continue;
    }
    accuracy::PlotSeries series{.name = one.name.substr(head.size()), .points = {}};
    for (const std::size_t count : kCounts) {
      const auto of_count = std::ranges::find(results, viewsName(count) + series.name, &BenchResult::name);
      if (of_count != results.end()) {
        series.points.push_back({static_cast<double>(count), of_count->value / one.value});
      }
    }
    figure.panels[one.unit == "MiB" ? 0 : 1].series.push_back(std::move(series));
  }
  return accuracy::renderSvg(figure);
}

Result<void> benchViews(const RecordingOptions& options, std::vector<BenchResult>& results) {
  if (const auto warm = measure(options, 1); !warm) {  // what is loaded once is loaded now
    return std::unexpected(warm.error());
  }
  ViewCosts one;
  for (const std::size_t count : kCounts) {
    const auto costs = measure(options, count);
    if (!costs) {
      return std::unexpected(costs.error());
    }
    one = count == 1 ? *costs : one;
    const std::string name = viewsName(count);
    results.push_back({name + "decoded and converted", costs->cache_mib, "MiB"});
    results.push_back({name + "heap of data and scenes", costs->scenes_mib, "MiB"});
    results.push_back({name + "heap of contexts and pictures, 640 x 360", costs->pictures_mib, "MiB"});
    results.push_back({name + "tick, first visit", costs->first_tick_ms, "ms"});
    results.push_back({name + "tick, cached", costs->tick_ms, "ms"});
    results.push_back({name + "a frame of each, 640 x 360", costs->frame_ms, "ms"});
    if (count > 1) {
      results.push_back({name + "decoded bytes / those of one", costs->cache_mib / one.cache_mib, "", 1.01});
      results.push_back({name + "heap of data and scenes / that of one", costs->scenes_mib / one.scenes_mib, ""});
      results.push_back({name + "first visit / that of one", costs->first_tick_ms / one.first_tick_ms, ""});
    }
  }
  return {};
}

}  // namespace stillframe::cli
