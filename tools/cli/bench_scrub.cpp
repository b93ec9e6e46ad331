#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/stopwatch.h"
#include "tools/cli/bench_results.h"
#include "tools/cli/bench_view.h"

namespace stillframe::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPositions = 40;           // of the slider, over the recording
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
  line("frame, on the window's thread", &BenchStep::frame_ms, 1.3 * BenchView::kBudgetMs);
}

constexpr int kMoreViews = 4;

/// What the heap grows by when four more views draw that instant, each with a context of its own.
Result<double> heapOfMoreViewsMib(const std::shared_ptr<scenegraph::Dataset>& dataset, tf::TimePoint time) {
  const double before_mib = heapMib();
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
  }
  return heapMib() - before_mib;
}

/// Memory of the data at rest: in all, and in how many views it is shown. A context whose OpenGL is software keeps its
/// textures and programs on the heap too, whatever is drawn: what views of nothing take is told apart.
Result<void> reportHeap(const std::shared_ptr<scenegraph::Dataset>& dataset, tf::TimePoint time, double one_view_mib,
                        std::vector<BenchResult>& results) {
  const double converted_mib = static_cast<double>(dataset->cache().bytes()) / (1024.0 * 1024.0);
  const auto empty_mib = heapOfMoreViewsMib(std::make_shared<scenegraph::Dataset>("nothing"), time);
  if (!empty_mib) {
    return std::unexpected(empty_mib.error());
  }
  const auto more_mib = heapOfMoreViewsMib(dataset, time);
  if (!more_mib) {
    return std::unexpected(more_mib.error());
  }
  const double ours_mib = one_view_mib + *more_mib - *empty_mib;
  results.push_back({"converted clouds of the first picture", converted_mib, "MiB"});
  results.push_back({"heap of data, scene and picture", one_view_mib, "MiB"});
  results.push_back({"heap / converted clouds", one_view_mib / converted_mib, "", 1.5});
  results.push_back({"heap of a further view, of nothing: its OpenGL", *empty_mib / kMoreViews, "MiB"});
  results.push_back(
      {"heap of a further view of the clouds, beyond that", (*more_mib - *empty_mib) / kMoreViews, "MiB"});
  results.push_back({"heap / converted clouds, 4 views more, without their OpenGL", ours_mib / converted_mib, "", 1.5});
  results.push_back({"heap / converted clouds, 4 views more, with it", (one_view_mib + *more_mib) / converted_mib, ""});
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
  if (const auto heap = reportHeap(dataset, *first_time, heapMib() - heap_before_mib, results); !heap) {
    return heap;
  }
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
