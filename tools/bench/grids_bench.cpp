// Occupancy grids: 10 000 patches of 64 x 64 cells on a base of 4000 x 4000. A seek to a random place should take less
// than 5 ms after the first pass.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "scenegraph/stopwatch.h"
#include "tools/bench/grid_workload.h"

namespace stillframe::bench {
namespace {

const PatchStream& stream() {
  static const PatchStream kStream;
  return kStream;
}

void firstPass(benchmark::State& state) {
  for (auto _ : state) {
    auto history = stream().makeHistory();
    benchmark::DoNotOptimize(stream().seek(history, PatchStream::kPatches)->applied);
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * PatchStream::kPatches));
}

void randomSeek(benchmark::State& state) {
  auto history = stream().makeHistory();
  (void)stream().seek(history, PatchStream::kPatches);
  std::mt19937 random(4);
  double longest_ms = 0.0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(stream().seek(history, random() % (PatchStream::kPatches + 1))->applied);
    longest_ms = std::max(longest_ms, scenegraph::millisecondsSince(start));
  }
  state.counters["longest_ms"] = longest_ms;
  state.counters["checkpoints"] = static_cast<double>(history.checkpointCount());
  state.counters["MiB"] = static_cast<double>(history.byteSize()) / (1U << 20U);
}

void nextPatch(benchmark::State& state) {
  auto history = stream().makeHistory();
  (void)stream().seek(history, PatchStream::kPatches);
  std::size_t at = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(stream().seek(history, at)->applied);
    at = (at + 1) % PatchStream::kPatches;
  }
}

BENCHMARK(firstPass)->Unit(benchmark::kMillisecond);
BENCHMARK(randomSeek)->Unit(benchmark::kMillisecond);
BENCHMARK(nextPatch)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace stillframe::bench

BENCHMARK_MAIN();
