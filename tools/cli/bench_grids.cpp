#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <span>
#include <stdexcept>

#include "nodes/registry.h"
#include "scenegraph/executor.h"
#include "scenegraph/objects/grid_map.h"
#include "scenegraph/scene.h"
#include "tools/bench/grid_workload.h"
#include "tools/bench/memory_messages.h"
#include "tools/cli/bench_results.h"

namespace stillframe::cli {
namespace {

/// A height field with another quantity beside it.
scenegraph::AnyObject gridMap(std::uint32_t side, float phase) {
  scenegraph::GridMap map;
  map.frame_id = "map";
  map.cell_size_m = {0.1, 0.1};
  map.column_count = map.row_count = side;
  map.cell_stride = 2 * sizeof(float);
  map.row_stride = side * map.cell_stride;
  map.fields = {{"elevation", 0, scenegraph::FieldType::Float32},
                {"traversability", 4, scenegraph::FieldType::Float32}};
  std::vector<float> values;
  values.reserve(std::size_t{side} * side * 2);
  for (std::size_t i = 0; i < std::size_t{side} * side; ++i) {
    values.push_back(i % 1009 == 0 ? NAN : std::sin(phase + static_cast<float>(i % side) * 0.01F));
    values.push_back(static_cast<float>(i % 256));
  }
  const auto bytes = std::as_bytes(std::span(values));
  const auto held = std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end());
  map.data = {*held, held};
  return scenegraph::AnyObject::make(std::move(map));
}

/// Whole ticks, conversion and all: each to a map not seen before, then the same one again, then hidden.
void addGridMapTicks(std::vector<BenchResult>& results) {
  constexpr std::int64_t kMaps = 4;
  std::vector<scenegraph::AnyObject> maps;
  for (std::int64_t i = 0; i < kMaps; ++i) {
    maps.push_back(gridMap(2000, static_cast<float>(i)));
  }
  const auto dataset = std::make_shared<scenegraph::Dataset>("bench");
  bench::addTopic(*dataset, "/map", scenegraph::ObjectType::GridMap, std::move(maps), kMaps);
  const auto executor = scenegraph::makeSynchronousExecutor();
  scenegraph::Scene scene(dataset, nodes::layerTypes(), *executor);
  scene.setFixedFrame("map");
  const auto slot = scene.addLayer("/map");
  if (!slot) {
    throw std::logic_error("the benchmark's grid map has no layer");
  }
  std::int64_t time = -kMaps;
  const double new_s = bestSecondsOf(kMaps, [&] { scene.update({time += kMaps}); });
  if (!scene.boundsInFixed().valid()) {
    throw std::logic_error("the benchmark's grid map was not drawn");
  }
  const double same_s = bestSecondsOf(kMaps - 1, [&] { scene.update({++time}); });
  (*slot)->layer->setVisible(false);
  scene.update({++time});
  const double hidden_s = bestSecondsOf(100, [&] { scene.update({--time}); });
  results.push_back({"grid map of 4 M cells, tick to a new one", 1e3 * new_s, "ms"});
  results.push_back({"grid map of 4 M cells, tick to the same one", 1e3 * same_s, "ms", 1.0});
  results.push_back({"grid map of 4 M cells, hidden, tick", 1e3 * hidden_s, "ms", 0.1});
}

}  // namespace

void benchGrids(std::vector<BenchResult>& results) {
  const bench::PatchStream stream;
  std::vector<std::byte> from(std::size_t{bench::PatchStream::kSide} * bench::PatchStream::kSide);
  std::vector<std::byte> copy(from.size());
  const double megabytes = static_cast<double>(from.size()) * 1e-6;
  const double copied_s = bestSecondsOf(5, [&] { std::memcpy(copy.data(), from.data(), from.size()); });
  results.push_back({"memcpy of a grid's 4000 x 4000 cells", megabytes / copied_s, "MB/s"});
  const double converted_s = bestSecondsOf(5, [&] { (void)stream.makeHistory(); });
  results.push_back({"occupancy grid, conversion", megabytes / converted_s, "MB/s"});

  auto history = stream.makeHistory();
  const double first_s = secondsOf([&] { (void)stream.seek(history, bench::PatchStream::kPatches); });
  results.push_back({"occupancy grid, first pass of 10 000 patches", 1e3 * first_s, "ms"});
  // The same places three times: what one round has and the others have not is the machine's.
  std::vector<double> seeks_ms(300, 1e9);
  for (int round = 0; round < 3; ++round) {
    std::mt19937 random(7);
    for (double& best_ms : seeks_ms) {
      const std::size_t place = random() % (bench::PatchStream::kPatches + 1);
      best_ms = std::min(best_ms, 1e3 * secondsOf([&] { (void)stream.seek(history, place); }));
    }
  }
  std::ranges::sort(seeks_ms);
  results.push_back({"occupancy grid, seek among 10 000 patches, median", quantile(seeks_ms, 0.5), "ms"});
  results.push_back({"occupancy grid, seek among 10 000 patches, longest", seeks_ms.back(), "ms", 5.0});
  addGridMapTicks(results);
}

}  // namespace stillframe::cli
