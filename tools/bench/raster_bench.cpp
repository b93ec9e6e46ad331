// Points drawn on the CPU: what a picture of 1 and 10 million points costs, and what a part of their passes.
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "scenegraph/raster/point_raster.h"

namespace stillframe::scenegraph {
namespace {

constexpr int kWidthPx = 1280;
constexpr int kHeightPx = 720;

/// A plain of hills before the camera, in the order of a scanner or shuffled.
std::vector<float> makeCloud(std::size_t count, bool is_shuffled) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  std::vector<float> cloud(count * 3);
  for (std::size_t i = 0; i < count; ++i) {
    const float along = is_shuffled ? unit(random) : static_cast<float>(i) / static_cast<float>(count);
    const float across = unit(random);
    cloud[3 * i] = across * 40.0F - 20.0F;
    cloud[3 * i + 1] = -2.0F + unit(random);
    cloud[3 * i + 2] = -1.0F - along * 60.0F;
  }
  return cloud;
}

glm::dmat4 clipFromPoints() {
  glm::dmat4 clip(0.0);
  clip[0][0] = static_cast<double>(kHeightPx) / kWidthPx * 1.7;
  clip[1][1] = 1.7;
  clip[2][3] = -1.0;
  clip[3][2] = 0.01;
  return clip;
}

void drawCloud(benchmark::State& state) {
  const std::vector<float> cloud = makeCloud(static_cast<std::size_t>(state.range(0)), state.range(1) != 0);
  const PointBatch batch{.positions = cloud, .clip_from_points = clipFromPoints()};
  const auto passes = static_cast<std::uint32_t>(state.range(2));
  PointRaster raster(static_cast<unsigned>(state.range(3)));
  for ([[maybe_unused]] auto _ : state) {
    raster.begin(kWidthPx, kHeightPx);
    raster.draw({&batch, 1}, {0, passes});
    benchmark::DoNotOptimize(raster.keys().data());
  }
  state.counters["points/s"] = benchmark::Counter(
      static_cast<double>(batch.count()) * passes / kPassesOfSample * static_cast<double>(state.iterations()),
      benchmark::Counter::kIsRate);
}

BENCHMARK(drawCloud)
    ->Name("raster/draw")
    ->ArgNames({"points", "shuffled", "passes", "threads"})
    ->ArgsProduct({{1'000'000, 10'000'000}, {0, 1}, {1024, 102, 10}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace stillframe::scenegraph
