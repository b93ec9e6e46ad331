#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "nodes/registry.h"
#include "scenegraph/executor.h"
#include "scenegraph/pipeline/offscreen_renderer.h"
#include "scenegraph/pipeline/point_collection.h"
#include "scenegraph/raster/point_raster.h"
#include "scenegraph/raster/points_in_view.h"
#include "scenegraph/scene.h"
#include "tools/bench/point_scene.h"
#include "tools/cli/bench_results.h"

namespace stillframe::cli {
namespace {

using scenegraph::PointWay;

constexpr int kWidthPx = 1280;
constexpr int kHeightPx = 720;
constexpr double kBudgetMs = 33.0;

/// Largest memory of this process since resetPeak(), in MB; 0 where the system does not say.
double peakMb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) {
      return std::stod(line.substr(6)) * 1.024e-3;
    }
  }
  return 0.0;
}

void resetPeak() { std::ofstream("/proc/self/clear_refs") << "5"; }

/// One picture of a scene, with a context of its own as every view of the window has.
struct View {
  std::unique_ptr<scenegraph::OffscreenRenderer> renderer;
  std::unique_ptr<scenegraph::Scene> scene;
};

struct Frame {
  double wall_ms = 0.0;
  double cpu_ms = 0.0;
  double raster_ms = 0.0;
  double share = 1.0;
  std::size_t upload_bytes = 0;
};

/// The views of one scene; more than one share the area of one.
class Views {
 public:
  Views(const std::shared_ptr<scenegraph::Dataset>& dataset, int layers, int views)
      : executor_(scenegraph::makeSynchronousExecutor()), per_axis_(views > 1 ? 2 : 1) {
    for (int i = 0; i < views; ++i) {
      auto renderer = scenegraph::OffscreenRenderer::create();
      if (!renderer) {
        throw std::runtime_error(renderer.error().message);
      }
      View& view = views_.emplace_back();
      view.renderer = std::move(*renderer);
      view.scene = std::make_unique<scenegraph::Scene>(dataset, nodes::layerTypes(), *executor_);
      view.scene->setFixedFrame("map");
      for (int layer = 0; layer < layers; ++layer) {
        const auto slot = view.scene->addLayer("/points" + std::to_string(layer));
        if (!slot || !(*slot)->layer->applySettings({{"point_size", "1"}, {"color_field", "intensity"}})) {
          throw std::logic_error("the benchmark's points have no layer");
        }
      }
    }
  }

  void update() {
    for (View& view : views_) {
      view.scene->update({0});
    }
  }
  Frame draw(PointWay way, const scenegraph::CameraView& camera, double budget_ms) {
    Frame sum;
    for (View& view : views_) {
      const auto drawn =
          view.renderer->render(view.scene->root(), camera,
                                {.width = kWidthPx / per_axis_,
                                 .height = kHeightPx / per_axis_,
                                 .points = way,
                                 .point_limits = {.budget_ms = budget_ms / static_cast<double>(views_.size())}});
      if (!drawn) {
        throw std::runtime_error(drawn.error().message);
      }
      const scenegraph::FrameStatistics& frame = view.renderer->lastFrame();
      sum.wall_ms += frame.frame_ms;
      sum.cpu_ms += frame.cpu_ms;
      if (frame.points) {
        sum.raster_ms += frame.points->raster_ms;
        sum.upload_bytes += frame.points->upload_bytes;
        sum.share = std::min(sum.share, frame.points->share);
      }
    }
    return sum;
  }
  [[nodiscard]] View& front() { return views_.front(); }
  [[nodiscard]] const std::string& rendererName() { return views_.front().renderer->context().info().renderer; }

 private:
  std::unique_ptr<scenegraph::Executor> executor_;
  int per_axis_;
  std::vector<View> views_;
};

constexpr std::array kWays{std::pair(PointWay::OpenGl, "gl"), std::pair(PointWay::Compute, "compute"),
                           std::pair(PointWay::Cpu, "cpu")};
constexpr std::size_t kGl = 0;
constexpr std::size_t kCpu = 2;

/// The least of two frames' numbers, each on its own.
void takeLeast(Frame& least, const Frame& frame) {
  least.wall_ms = std::min(least.wall_ms, frame.wall_ms);
  least.cpu_ms = std::min(least.cpu_ms, frame.cpu_ms);
}

Frame never() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {.wall_ms = kInfinity, .cpu_ms = kInfinity};
}

scenegraph::PointCollection pointsOf(View& view, const scenegraph::CameraView& camera) {
  const glm::dmat4 clip_from_eye = scenegraph::projection(camera, static_cast<double>(kWidthPx) / kHeightPx);
  return scenegraph::collectPoints(view.scene->root(), osg::Matrixd(&camera.eye_from_fixed[0][0]),
                                   osg::Matrixd(&clip_from_eye[0][0]), kHeightPx);
}

/// The loop over points alone, of what the view draws: what everything else is measured against.
double bareMs(View& view, const scenegraph::CameraView& camera, scenegraph::PointRaster& raster) {
  const scenegraph::PointCollection points = pointsOf(view, camera);
  return 1e3 * secondsOf([&] {
           raster.begin(kWidthPx, kHeightPx);
           raster.draw(points.batches);
         });
}

/// Whole frames by each way, in turn, so that what else the machine does falls on all alike.
void benchFrames(std::vector<BenchResult>& results, const std::string& name, const bench::PointSceneShape& shape,
                 int views) {
  const int rounds = shape.points > 2'000'000 ? 1 : 4;
  resetPeak();
  Views scene(bench::makePointDataset(shape), shape.layers, views);
  const double updated_ms = 1e3 * secondsOf([&] { scene.update(); });
  constexpr double kNoBudget = std::numeric_limits<double>::infinity();
  std::array<Frame, kWays.size()> least{never(), never(), never()};
  std::array<Frame, kWays.size()> first;
  double bare_ms = kNoBudget;
  scenegraph::PointRaster raster;
  for (int round = 0; round <= rounds; ++round) {
    const scenegraph::CameraView camera = bench::viewOfAllPoints(round);
    for (std::size_t way = 0; way < kWays.size(); ++way) {
      const Frame frame = scene.draw(kWays[way].first, camera, kNoBudget);
      if (round == 0) {
        first[way] = frame;
      } else if (way == kGl) {
        takeLeast(least[way], frame);
      } else {
        // What comes after another way is made anew; the second frame is one among many.
        takeLeast(least[way], scene.draw(kWays[way].first, bench::viewOfAllPoints(100 + round), kNoBudget));
      }
    }
    // The pipeline on the CPU and the loop, once more in turn.
    for (int i = 0; i < 3 && views == 1 && round > 0; ++i) {
      const scenegraph::CameraView aside = bench::viewOfAllPoints(10 * round + i);
      bare_ms = std::min(bare_ms, bareMs(scene.front(), aside, raster));
      takeLeast(least[kCpu], scene.draw(PointWay::Cpu, aside, kNoBudget));
    }
  }
  results.push_back({name + ", conversion and first tick", updated_ms, "ms"});
  for (std::size_t way = 0; way < kWays.size(); ++way) {
    const std::string by = name + ", " + kWays[way].second;
    results.push_back({by + ", first frame", first[way].wall_ms, "ms"});
    results.push_back({by + ", frame", least[way].wall_ms, "ms"});
    results.push_back({by + ", CPU time of a frame", least[way].cpu_ms, "ms"});
  }
  results.push_back({name + ", cpu, upload of a frame", static_cast<double>(first[kCpu].upload_bytes) * 1e-6, "MB"});
  results.push_back({name + ", memory peak", peakMb(), "MB"});
  const bool is_large = shape.points > 2'000'000;
  results.push_back({name + ", cpu / gl", least[kCpu].wall_ms / least[kGl].wall_ms, "",
                     is_large ? std::optional(0.15) : std::nullopt});
  if (views == 1) {
    results.push_back({name + ", bare loop over the points", bare_ms, "ms"});
    results.push_back({name + ", pipeline over bare loop", least[kCpu].wall_ms / bare_ms, "",
                       is_large ? std::optional(1.25) : std::nullopt});
  }
}

/// What blocks leave out: of the points all that are out of the picture or behind others, and while the picture refines
/// what is more than their pixels are worth.
void benchBlocks(std::vector<BenchResult>& results, const std::string& name, View& view,
                 const scenegraph::CameraView& camera) {
  const scenegraph::PointCollection points = pointsOf(view, camera);
  scenegraph::PointsInView in_view;
  for (const scenegraph::PointBatch& batch : points.batches) {
    in_view.add(batch, kWidthPx, kHeightPx);
  }
  scenegraph::PointRaster raster;
  raster.begin(kWidthPx, kHeightPx);
  const std::size_t whole = raster.draw(points.batches);
  const auto percent = [&](double part) { return 100.0 * part / static_cast<double>(points.count); };
  results.push_back({name + ", points in view", percent(static_cast<double>(in_view.count())), "%"});
  results.push_back(
      {name + ", points of the first lap", percent(in_view.drawnBefore(scenegraph::kPassesOfSample)), "%"});
  results.push_back({name + ", points drawn for the whole", percent(static_cast<double>(whole)), "%"});
}

/// Frames while the camera moves, within and about the points.
void benchMoving(std::vector<BenchResult>& results, const std::string& name, const bench::PointSceneShape& shape) {
  Views scene(bench::makePointDataset(shape), shape.layers, 1);
  scene.update();
  for (const auto& [where, camera] :
       {std::pair("from outside", &bench::viewOfAllPoints), std::pair("from within", &bench::viewOfPoints),
        std::pair("from afar", &bench::viewFromAfar)}) {
    std::vector<double> frames_ms;
    double share = 0.0;
    for (int step = 0; step < 40; ++step) {
      const Frame frame = scene.draw(PointWay::Cpu, camera(step), kBudgetMs);
      if (step >= 10) {
        frames_ms.push_back(frame.wall_ms);
        share += frame.share / 30.0;
      }
    }
    std::ranges::sort(frames_ms);
    const std::string moving = name + ", moving, " + where;
    results.push_back({moving + ", median frame / budget of 33 ms", quantile(frames_ms, 0.5) / kBudgetMs, "", 1.3});
    results.push_back({moving + ", points drawn", 100.0 * share, "%"});
    benchBlocks(results, name + ", " + where, scene.front(), camera(0));
  }
}

std::string nameOf(const bench::PointSceneShape& shape, int views) {
  std::string name = std::to_string(shape.points / 1'000'000) + " M points, " + (shape.is_shuffled ? "random" : "scan");
  if (shape.layers > 1) {
    name += ", " + std::to_string(shape.layers) + " layers";
  }
  if (views > 1) {
    name += ", " + std::to_string(views) + " views";
  }
  return name;
}

}  // namespace

void benchPoints(std::vector<BenchResult>& results) {
  for (const std::size_t points : {1'000'000U, 10'000'000U}) {
    for (const bool is_shuffled : {true, false}) {
      for (const auto& [layers, views] : {std::pair(1, 1), std::pair(4, 1), std::pair(1, 4), std::pair(4, 4)}) {
        const bench::PointSceneShape shape{.points = points, .is_shuffled = is_shuffled, .layers = layers};
        benchFrames(results, nameOf(shape, views), shape, views);
      }
      const bench::PointSceneShape shape{.points = points, .is_shuffled = is_shuffled};
      benchMoving(results, nameOf(shape, 1), shape);
    }
  }
}

}  // namespace stillframe::cli
