#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "scenegraph/stopwatch.h"
#include "tools/cli/bench_results.h"
#include "tools/cli/bench_view.h"
#include "tools/cli/temporary_sample.h"
#include "tools/sample/sample.h"

namespace stillframe::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPositions = 40;  // of the slider, over the recording
constexpr double kMib = 1024.0 * 1024.0;
constexpr double kLongestRoundS = 60.0;  // there and back; a shorter way where that is not enough

void report(std::vector<BenchResult>& results, const std::string& name, const std::vector<BenchStep>& steps) {
  const auto line = [&](const char* what, double BenchStep::* member, std::optional<double> at_most) {
    std::vector<double> values;
    for (const BenchStep& step : steps) {
      values.push_back(step.*member);
    }
    std::ranges::sort(values);
    for (const auto& [title, part] : {std::pair("median", 0.5), std::pair("95 %", 0.95), std::pair("longest", 1.0)}) {
      results.push_back(
          {name + ", " + what + ", " + title, quantile(values, part), "ms", part == 1.0 ? at_most : std::nullopt});
    }
  };
  constexpr double kUnnoticed = 16.0;
  line("slider to picture", &BenchStep::picture_ms, {});
  line("slider to all of it", &BenchStep::complete_ms, {});
  line("tick, on the window's thread", &BenchStep::tick_ms, kUnnoticed);
  line("step of a frame, on the window's thread", &BenchStep::stall_ms, kUnnoticed);
  line("frame", &BenchStep::frame_ms, 1.3 * BenchView::kBudgetMs);
}

/// How long the machine takes a core away from a loop that does nothing but look at the clock, on all of them at once:
/// shorter than that nothing can be promised to be.
double longestGapMs() {
  constexpr double kLookedMs = 10'000.0;
  std::vector<double> gaps_ms(std::max(1U, std::thread::hardware_concurrency()));
  {
    std::vector<std::jthread> threads;
    for (double& gap_ms : gaps_ms) {
      threads.emplace_back([&gap_ms] {
        const Clock::time_point start = Clock::now();
        double longest_ms = 0.0;
        for (double at_ms = 0.0; at_ms < kLookedMs;) {
          const double now_ms = scenegraph::millisecondsSince(start);
          longest_ms = std::max(longest_ms, now_ms - at_ms);
          at_ms = now_ms;
        }
        gap_ms = longest_ms;
      });
    }
  }
  return std::ranges::max(gaps_ms);
}

constexpr int kMoreViews = 4;

/// What the heap grows by for each of four more views of that instant, which have contexts of their own, beside what
/// the dataset has converted meanwhile.
Result<double> heapOfFurtherViewMib(const std::shared_ptr<scenegraph::Dataset>& dataset, tf::TimePoint time) {
  const auto heapOfViews = [&] { return heapMib() - static_cast<double>(dataset->cache().bytes()) / kMib; };
  const double before_mib = heapOfViews();
  std::vector<std::unique_ptr<BenchView>> views;
  for (int i = 0; i < kMoreViews; ++i) {
    auto renderer = scenegraph::OffscreenRenderer::create();
    if (!renderer) {
      return failure(renderer.error().message);
    }
    views.push_back(std::make_unique<BenchView>(dataset, std::move(*renderer)));
    if (const auto drawn = views.back()->go(time); !drawn) {
      return std::unexpected(drawn.error());
    }
    views.back()->rest();
  }
  return (heapOfViews() - before_mib) / kMoreViews;
}

/// The same of small clouds, of just enough points to be drawn by the CPU, so that it is the view that takes it, not
/// its points.
Result<double> heapOfFewPointsMib() {
  const TemporarySample sample;
  if (const auto made = sample::writeSample(sample.path(), {.duration_ns = 200'000'000, .lidar_points = 100'000});
      !made) {
    return failure(made.error().message);
  }
  RecordingOptions options;
  options.file = sample.path().string();
  const auto recording = openRecording(options);
  if (!recording) {
    return std::unexpected(recording.error());
  }
  const auto time = firstCloudInstant((*recording)->dataset()->store());
  return heapOfFurtherViewMib((*recording)->dataset(), time.value_or(tf::TimePoint{}));
}

/// Memory of the data at rest: in all, and for further views. A view has the pixels of its picture, ours and, where
/// OpenGL is software, its textures and programs, however many points there are: that is told apart.
Result<void> reportHeap(const std::shared_ptr<scenegraph::Dataset>& dataset, tf::TimePoint time, double one_view_mib,
                        std::vector<BenchResult>& results) {
  const double converted_mib = static_cast<double>(dataset->cache().bytes()) / kMib;
  const auto nothing_mib = heapOfFurtherViewMib(std::make_shared<scenegraph::Dataset>("nothing"), time);
  const auto few_mib = heapOfFewPointsMib();
  const auto clouds_mib = heapOfFurtherViewMib(dataset, time);
  for (const auto* const heap : {&nothing_mib, &few_mib, &clouds_mib}) {
    if (!*heap) {
      return std::unexpected(heap->error());
    }
  }
  const double points_mib = kMoreViews * (*clouds_mib - *few_mib);
  results.push_back({"converted clouds of the first picture", converted_mib, "MiB"});
  results.push_back({"heap of data, scene and picture", one_view_mib, "MiB"});
  results.push_back({"heap / converted clouds", one_view_mib / converted_mib, "", 1.5});
  results.push_back({"a further view: its OpenGL, of nothing", *nothing_mib, "MiB"});
  results.push_back(
      {"a further view: pixels of points, in our memory and in OpenGL's", *few_mib - *nothing_mib, "MiB"});
  results.push_back({"a further view: the clouds", *clouds_mib - *few_mib, "MiB"});
  results.push_back({"heap / converted clouds, 4 views more", (one_view_mib + points_mib) / converted_mib, "", 1.5});
  results.push_back({"heap / converted clouds, 4 views more, with their pixels and OpenGL",
                     (one_view_mib + kMoreViews * *clouds_mib) / converted_mib, ""});
  return {};
}

}  // namespace

Result<void> benchScrub(const RecordingOptions& options, std::vector<BenchResult>& results) {
  auto renderer = scenegraph::OffscreenRenderer::create();
  if (!renderer) {
    return failure(renderer.error().message);
  }
  const double heap_before_mib = heapMib();
  auto recording = openRecording(options);
  if (!recording) {
    return std::unexpected(recording.error());
  }
  const auto& dataset = (*recording)->dataset();
  const auto range = dataset->timeRange();
  const auto first_time = firstCloudInstant(dataset->store());
  if (!range || !first_time) {
    return failure(options.file + ": the recording holds no clouds");
  }
  BenchView view(dataset, std::move(*renderer));
  if (const auto first = view.go(*first_time); !first) {
    return std::unexpected(first.error());
  }
  view.rest();
  if (const auto heap = reportHeap(dataset, *first_time, heapMib() - heap_before_mib, results); !heap) {
    return heap;
  }
  results.push_back({"longest that a loop that does nothing is without its core, in 10 s", longestGapMs(), "ms"});
  const double span_ns = tf::secondsBetween(range->first, range->second) * 1e9;
  for (const char* const name : {"scrub, first visit", "scrub, again"}) {
    std::vector<BenchStep> steps;
    const Clock::time_point begun = Clock::now();
    int turned_at = kPositions;
    for (int i = 0; i < 2 * turned_at; ++i) {
      if (turned_at == kPositions && scenegraph::millisecondsSince(begun) > 500.0 * kLongestRoundS) {
        turned_at = std::min(i, kPositions);
      }
      const int position = i < turned_at ? i : 2 * turned_at - 1 - i;  // there, and back
      const auto offset_ns = static_cast<std::int64_t>(span_ns * position / (kPositions - 1));
      const auto step = view.go(std::min(range->second, tf::TimePoint{range->first.ns + offset_ns}));
      if (!step) {
        return std::unexpected(step.error());
      }
      steps.push_back(*step);
    }
    report(results, name, steps);
  }
  const std::size_t cached_bytes = dataset->cache().bytes();
  results.push_back({"products kept for going back", static_cast<double>(cached_bytes) * 1e-6, "MB"});
  return {};
}

}  // namespace stillframe::cli
