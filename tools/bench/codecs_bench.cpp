// Decoding of compressed clouds as ratios within one run: `of_memcpy` is memcpy of the decoded bytes against ours,
// `of_bare` is libdraco alone against ours (the rest packs the points).
#include <benchmark/benchmark.h>

#include <chrono>
#include <cstring>

#include "nodes/points/codecs/cloudini.h"
#include "nodes/points/codecs/draco.h"
#include "scenegraph/stopwatch.h"
#include "tools/bench/codec_workloads.h"

namespace stillframe::bench {
namespace {

template <typename Function>
double secondsOf(const Function& function) {
  const auto start = std::chrono::steady_clock::now();
  function();
  benchmark::ClobberMemory();
  return scenegraph::secondsSince(start);
}

/// Times `ours` and `other` in turns and reports other / ours.
template <typename Ours, typename Other>
void compare(benchmark::State& state, const CodecWorkload& workload, const char* ratio, const Ours& ours,
             const Other& other) {
  double our_seconds = 0.0;
  double other_seconds = 0.0;
  for (auto _ : state) {
    const double seconds = secondsOf(ours);
    state.SetIterationTime(seconds);
    our_seconds += seconds;
    other_seconds += secondsOf(other);
  }
  state.counters[ratio] = other_seconds / our_seconds;
  state.SetBytesProcessed(static_cast<std::int64_t>(workload.points.size()) * state.iterations());
}

void cloudini(benchmark::State& state) {
  const CodecWorkload workload = makeCodecWorkload(static_cast<std::uint32_t>(state.range(0)));
  std::vector<std::byte> copy(workload.points.size());
  compare(
      state, workload, "of_memcpy", [&] { benchmark::DoNotOptimize(nodes::decodeCloudini(workload.cloudini)); },
      [&] { benchmark::DoNotOptimize(std::memcpy(copy.data(), workload.points.data(), copy.size())); });
}

void draco(benchmark::State& state) {
  const CodecWorkload workload = makeCodecWorkload(static_cast<std::uint32_t>(state.range(0)));
  compare(
      state, workload, "of_bare", [&] { benchmark::DoNotOptimize(nodes::decodeDraco(workload.draco)); },
      [&] { benchmark::DoNotOptimize(decodeBareDraco(workload.draco)); });
}

BENCHMARK(cloudini)->ArgName("points")->Arg(20'000)->Arg(500'000)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(draco)->ArgName("points")->Arg(20'000)->Arg(500'000)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace stillframe::bench

BENCHMARK_MAIN();
