// Google Benchmark of the TransformBuffer. Each name ends in its target.
#include <benchmark/benchmark.h>

#include "tools/bench/tf_workloads.h"

namespace stillframe::bench {
namespace {

using tf::FrameId;
using tf::Snapshot;
using tf::TransformBuffer;

/// The yardstick: 256 products in plain double. Lookups take so many of it on a fast machine and on a busy one.
void bmReferenceProduct(benchmark::State& state) {
  const ChainWorkload chain(256, 1);
  for (auto _ : state) {
    tf::RigidTransform product;
    for (const tf::TransformSample& sample : chain.samples()) {
      const tf::RigidTransform& link = sample.parent_from_child;
      product = {product.rotation * link.rotation, product.rotation * link.translation + product.translation};
    }
    benchmark::DoNotOptimize(product);
  }
}
BENCHMARK(bmReferenceProduct)->Name("Reference256PlainProducts")->Unit(benchmark::kMicrosecond);

void lookupAnyTime(benchmark::State& state, ChainWorkload& chain, const TransformBuffer& buffer) {
  const FrameId root = *buffer.findFrame(chain.root());
  const FrameId leaf = *buffer.findFrame(chain.leaf());
  std::vector<tf::TimePoint> times(1 << 16);
  for (tf::TimePoint& time : times) {
    time = chain.randomTime();
  }
  std::size_t next = 0;
  for (auto _ : state) {
    auto found = buffer.tryLookupTransform(root, leaf, times[next++ % times.size()]);
    if (!found) {
      state.SkipWithError("lookup failed");
      break;
    }
    benchmark::DoNotOptimize(found);
  }
}

std::unique_ptr<TransformBuffer> loadAndForget(ChainWorkload& chain) {
  auto loaded = chain.load();
  chain.forgetSamples();
  return loaded;
}

ChainWorkload shuffledChain() {
  ChainWorkload chain(16, 60'000);
  chain.shuffle();
  return chain;
}

void bmLookup16DeepInOneHourOf100Hz(benchmark::State& state) {
  static ChainWorkload chain(16, 360'000);
  static const auto buffer = loadAndForget(chain);
  lookupAnyTime(state, chain, *buffer);
  state.counters["target_us"] = 2;
}
BENCHMARK(bmLookup16DeepInOneHourOf100Hz)
    ->Name("Lookup16DeepInOneHourOf100Hz/target_below_2us")
    ->Unit(benchmark::kMicrosecond);

void bmLookup16DeepShuffledHour(benchmark::State& state) {
  static ChainWorkload chain(16, 360'000);
  static const auto buffer = [] {
    chain.shuffle();
    return loadAndForget(chain);
  }();
  lookupAnyTime(state, chain, *buffer);
  state.counters["target_us"] = 2;
}
BENCHMARK(bmLookup16DeepShuffledHour)
    ->Name("Lookup16DeepInOneHourThatCameShuffled/target_below_2us")
    ->Unit(benchmark::kMicrosecond);

void bmLookup16DeepAcrossADay(benchmark::State& state) {
  constexpr std::int64_t kDayNs = 86'400'000'000'000;
  static ChainWorkload chain(16, 360'000, kDayNs);
  static const auto buffer = loadAndForget(chain);
  lookupAnyTime(state, chain, *buffer);
  state.counters["target_us"] = 2;
}
BENCHMARK(bmLookup16DeepAcrossADay)
    ->Name("Lookup16DeepInTwoHalfHoursADayApart/target_below_2us")
    ->Unit(benchmark::kMicrosecond);

void bmLookup256DeepIn10sOf100Hz(benchmark::State& state) {
  static ChainWorkload chain(256, 1000);
  static const auto buffer = chain.load();
  lookupAnyTime(state, chain, *buffer);
  state.counters["target_us"] = 20;
}
BENCHMARK(bmLookup256DeepIn10sOf100Hz)
    ->Name("Lookup256DeepIn10sOf100Hz/target_below_20us")
    ->Unit(benchmark::kMicrosecond);

void bmSnapshotOf1000Frames(benchmark::State& state) {
  static const auto buffer = makeRandomTree(1000);
  Snapshot snapshot;
  std::int64_t tick = 0;
  for (auto _ : state) {
    buffer->snapshot(0, {1'700'000'000'000'000'000 + (tick++ % 100) * 10'000'000}, snapshot);
    benchmark::DoNotOptimize(snapshot.root_from_frame.data());
  }
  state.counters["target_us"] = 100;
}
BENCHMARK(bmSnapshotOf1000Frames)->Name("SnapshotOf1000Frames/target_below_100us")->Unit(benchmark::kMicrosecond);

void bulkInsert(benchmark::State& state, const ChainWorkload& chain, double target) {
  std::size_t bytes = 0;
  for (auto _ : state) {
    const auto buffer = chain.load();
    state.PauseTiming();
    bytes = buffer->sampleBytes();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(chain.samples().size()));
  state.counters["target_items_per_second"] = target;
  state.counters["bytes_per_sample_target_72"] =
      static_cast<double>(bytes) / static_cast<double>(chain.samples().size());
}

void bmBulkInsertInOrder(benchmark::State& state) {
  static const ChainWorkload chain(16, 60'000);
  bulkInsert(state, chain, 5e6);
}
BENCHMARK(bmBulkInsertInOrder)->Name("BulkInsertInOrder/target_above_5M_per_s")->Unit(benchmark::kMillisecond);

void bmBulkInsertShuffled(benchmark::State& state) {
  static const ChainWorkload chain = shuffledChain();
  bulkInsert(state, chain, 1e6);
}
BENCHMARK(bmBulkInsertShuffled)->Name("BulkInsertShuffled/target_above_1M_per_s")->Unit(benchmark::kMillisecond);

void singleInserts(benchmark::State& state, const ChainWorkload& chain) {
  for (auto _ : state) {
    TransformBuffer buffer;
    for (const tf::TransformSample& sample : chain.samples()) {
      benchmark::DoNotOptimize(buffer.insert(sample));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(chain.samples().size()));
}

void bmSingleInsertsInOrder(benchmark::State& state) {
  static const ChainWorkload chain(16, 60'000);
  singleInserts(state, chain);
}
BENCHMARK(bmSingleInsertsInOrder)->Name("SingleInsertsInOrder")->Unit(benchmark::kMillisecond);

void bmSingleInsertsShuffled(benchmark::State& state) {
  static const ChainWorkload chain = shuffledChain();
  singleInserts(state, chain);
}
BENCHMARK(bmSingleInsertsShuffled)->Name("SingleInsertsShuffled")->Unit(benchmark::kMillisecond);

void bmReaders(benchmark::State& state) {
  static const ChainWorkload chain(16, 6'000);
  static const auto buffer = chain.load();
  const auto readers = static_cast<int>(state.range(0));
  const auto writers = static_cast<int>(state.range(1));
  SharedRates rates;
  for (auto _ : state) {
    rates = sharedRates(*buffer, chain, readers, writers, 0.5);
    state.SetIterationTime(0.5);
  }
  state.counters["lookups_per_s"] = rates.lookups_per_s;
  state.counters["per_reader"] = rates.lookups_per_s / readers;
  state.counters["inserts_per_s"] = rates.inserts_per_s;
}
BENCHMARK(bmReaders)
    ->Name("Readers_Writers/target_no_slowdown_by_readers_and_above_a_third_beside_a_writer")
    ->Args({1, 0})
    ->Args({2, 0})
    ->Args({1, 1})
    ->Args({2, 1})
    ->Iterations(1)
    ->UseManualTime();

}  // namespace
}  // namespace stillframe::bench

BENCHMARK_MAIN();
