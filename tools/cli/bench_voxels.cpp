#include <cstring>
#include <glm/vec3.hpp>

#include "nodes/registry.h"
#include "nodes/voxel_grid/voxel_cells.h"
#include "nodes/voxel_grid/voxel_values.h"
#include "scenegraph/executor.h"
#include "scenegraph/pipeline/offscreen_renderer.h"
#include "scenegraph/scene.h"
#include "tools/bench/voxel_workload.h"
#include "tools/cli/bench_results.h"

namespace stillframe::cli {
namespace {

/// A scene of voxels alone.
struct VoxelScene {
  VoxelScene(std::uint32_t side, bool with_noise)
      : scene(bench::datasetOfVoxels(side, with_noise), nodes::layerTypes(), *executor) {
    scene.setFixedFrame("map");
    if (const auto slot = scene.addLayer("/voxels")) {
      layer = (*slot)->layer.get();
    }
    scene.update(tf::TimePoint{0});
  }
  /// Microseconds of a tick at which nothing is new but the time, and of one with another threshold.
  double tickUs(bool with_setting) {
    constexpr int kTicksARun = 1000;
    const auto run = [&] {
      for (int i = 0; i < kTicksARun; ++i) {
        if (with_setting) {
          (void)layer->applySettings({{"range_max", std::to_string(100 + i)}, {"range_mode", "manual"}});
        }
        scene.update(tf::TimePoint{++time_ns});
      }
    };
    return 1e6 * bestSecondsOf(5, run) / kTicksARun;
  }

  std::unique_ptr<scenegraph::Executor> executor = scenegraph::makeSynchronousExecutor();
  scenegraph::Scene scene;
  scenegraph::Layer* layer = nullptr;
  std::int64_t time_ns = 0;
};

void benchConversion(std::vector<BenchResult>& results) {
  constexpr std::uint32_t kSide = 256;
  const scenegraph::VoxelGrid grid = bench::makeVoxels(kSide, false);
  std::vector<std::byte> copy(grid.data.bytes.size());
  const double megabytes = static_cast<double>(copy.size()) * 1e-6;
  const double copied_s = bestSecondsOf(5, [&] { std::memcpy(copy.data(), grid.data.bytes.data(), copy.size()); });
  results.push_back({"memcpy of 256^3 voxels of a byte", megabytes / copied_s, "MB/s"});
  const auto cells = nodes::readVoxelCells(grid);
  if (!cells) {
    return;
  }
  const nodes::ChannelInfo& field = cells->layers.front();
  const nodes::VoxelFormat format = nodes::voxelFormat(field.type);
  std::vector<std::uint32_t> words(format.words(cells->all.points));
  const double converted_s = bestSecondsOf(5, [&] { (void)nodes::convertVoxels(*cells, field, words); });
  results.push_back({"voxel grid, conversion", megabytes / converted_s, "MB/s"});
  std::size_t listed = 0;
  const double listed_s = bestSecondsOf(5, [&] {
    const auto list = nodes::exposedVoxels(glm::uvec3(kSide), words, format, {}, cells->all.points / 2);
    listed = list ? list->size() : cells->all.points;
  });
  results.push_back({"voxel grid, finding the exposed ones", megabytes / listed_s, "MB/s"});
  results.push_back({"voxel grid, exposed of 256^3",
                     100.0 * static_cast<double>(listed) / static_cast<double>(cells->all.points), "%"});
}

void benchFrames(std::vector<BenchResult>& results) {
  auto renderer = scenegraph::OffscreenRenderer::create();
  if (!renderer) {
    return;
  }
  VoxelScene voxels(128, true);
  if (voxels.layer == nullptr) {
    return;
  }
  const scenegraph::CameraView view{.eye_from_fixed = scenegraph::lookAt({-4, -5, 6}, {3, 3, 2}, {0, 0, 1})};
  for (const auto& [field, name] : {std::pair{"noisy", "voxel grid, frame of 128^3, all gone through"},
                                    std::pair{"occupancy", "voxel grid, the same frame, the exposed ones"}}) {
    (void)voxels.layer->applySettings({{"draw_field", field}, {"draw_from", "50"}, {"color_field", "z"}});
    voxels.scene.update(tf::TimePoint{++voxels.time_ns});
    const auto draw = [&] { (void)(*renderer)->render(voxels.scene.root(), view, {.width = 640, .height = 480}); };
    draw();
    double best_ms = (*renderer)->lastFrame().frame_ms;
    for (int i = 0; i < 3; ++i) {
      draw();
      best_ms = std::min(best_ms, (*renderer)->lastFrame().frame_ms);
    }
    results.push_back({name, best_ms, "ms"});
  }
}

}  // namespace

void benchVoxels(std::vector<BenchResult>& results) {
  benchConversion(results);
  for (const auto& [side, name] :
       {std::pair{32U, "voxel grid, tick over 32^3"}, std::pair{256U, "voxel grid, tick over 256^3"}}) {
    VoxelScene voxels(side, false);
    if (voxels.layer != nullptr) {
      results.push_back({name, voxels.tickUs(false), "us"});
      results.push_back({std::string(name) + " with another range", voxels.tickUs(true), "us"});
    }
  }
  benchFrames(results);
}

}  // namespace stillframe::cli
