#include "tools/bench/tf_bench_lines.h"

#include <algorithm>
#include <chrono>
#include <functional>

#include "tools/bench/tf_workloads.h"

namespace stillframe::bench {
namespace {

using Clock = std::chrono::steady_clock;

double secondsOf(const std::function<void()>& work) {
  const auto start = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Median seconds of one run, over as many as fit; at least three.
double medianSeconds(double budget, const std::function<void()>& work) {
  std::vector<double> runs;
  for (double spent = 0.0; spent < budget || runs.size() < 3; spent += runs.back()) {
    runs.push_back(secondsOf(work));
  }
  const auto middle = runs.begin() + static_cast<std::ptrdiff_t>(runs.size() / 2);
  std::nth_element(runs.begin(), middle, runs.end());
  return *middle;
}

double lookupMicroseconds(ChainWorkload& chain, const tf::TransformBuffer& buffer, double budget) {
  constexpr int kLookups = 100;
  const tf::FrameId root = *buffer.findFrame(chain.root());
  const tf::FrameId leaf = *buffer.findFrame(chain.leaf());
  double sum = 0.0;  // keeps the lookups from being optimised away
  const double seconds = medianSeconds(budget, [&] {
    for (int i = 0; i < kLookups; ++i) {
      sum += buffer.tryLookupTransform(root, leaf, chain.randomTime())->translation.x;
    }
  });
  return sum == sum ? seconds * 1e6 / kLookups : 0.0;
}

void addLookups(std::vector<BenchLine>& lines, double budget) {
  {
    ChainWorkload chain(16, 360'000);
    const auto buffer = chain.load();
    chain.forgetSamples();
    lines.push_back(
        {"tf lookup, 16 deep, any time in 1 h of 100 Hz", lookupMicroseconds(chain, *buffer, budget), "us", 2});
  }
  ChainWorkload chain(256, 1000);
  const auto buffer = chain.load();
  lines.push_back(
      {"tf lookup, 256 deep, any time in 10 s of 100 Hz", lookupMicroseconds(chain, *buffer, budget), "us", 20});
  const auto tree = makeRandomTree(1000);
  tf::Snapshot snapshot;
  std::int64_t tick = 0;
  const double seconds = medianSeconds(
      budget, [&] { tree->snapshot(0, {1'700'000'000'000'000'000 + (tick++ % 100) * 10'000'000}, snapshot); });
  lines.push_back({"tf snapshot of 1000 frames", seconds * 1e6, "us", 100});
}

void addInserts(std::vector<BenchLine>& lines, double budget) {
  ChainWorkload chain(16, 30'000);
  const auto count = static_cast<double>(chain.samples().size());
  const auto millionsPerSecond = [&] { return count * 1e-6 / medianSeconds(budget, [&] { (void)chain.load(); }); };
  const auto bytesPerSample = [&] { return static_cast<double>(chain.load()->sampleBytes()) / count; };
  lines.push_back({"tf bulk insert in order", millionsPerSecond(), "M/s", 5, false});
  lines.push_back({"tf memory, loaded in order", bytesPerSample(), "B/sample", 72});
  chain.shuffle();
  lines.push_back({"tf bulk insert shuffled", millionsPerSecond(), "M/s", 1, false});
  lines.push_back({"tf memory, loaded shuffled", bytesPerSample(), "B/sample", 72});
}

void addReaders(std::vector<BenchLine>& lines, double budget) {
  const ChainWorkload chain(16, 6000);
  const auto buffer = chain.load();
  // The best of turns: what else the machine does in one of them is not the buffer's doing.
  double alone = 0.0;
  double beside_reader = 0.0;
  double beside_writer = 0.0;
  constexpr int kTurns = 4;
  for (int turn = 0; turn < kTurns; ++turn) {
    const auto lookups = [&](int readers, int writers) {
      return sharedRates(*buffer, chain, readers, writers, budget / kTurns).lookups_per_s;
    };
    alone = std::max(alone, lookups(1, 0));
    beside_reader = std::max(beside_reader, lookups(2, 0) / 2.0);
    beside_writer = std::max(beside_writer, lookups(1, 1));
  }
  lines.push_back({"tf reader beside a reader, of its rate alone", beside_reader / alone, "", 0.8, false});
  lines.push_back({"tf reader beside a bulk writer, of its rate alone", beside_writer / alone, "", 1.0 / 3.0, false});
}

}  // namespace

std::vector<BenchLine> runTfBench(double seconds_per_case) {
  std::vector<BenchLine> lines;
  addLookups(lines, seconds_per_case);
  addInserts(lines, seconds_per_case);
  addReaders(lines, seconds_per_case);
  return lines;
}

}  // namespace stillframe::bench
