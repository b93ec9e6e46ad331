#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "nodes/registry.h"
#include "scenegraph/camera/camera_rig.h"
#include "scenegraph/executor.h"
#include "scenegraph/pipeline/offscreen_renderer.h"
#include "scenegraph/scene.h"
#include "scenegraph/stopwatch.h"
#include "tools/cli/bench_results.h"
#include "tools/cli/recording_options.h"

namespace stillframe::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPositions = 40;  // of the slider, over the recording
constexpr double kScrubBudgetMs = 33.0;
constexpr double kLongestWaitS = 20.0;
constexpr double kLongestRoundS = 60.0;  // there and back; a shorter way where that is not enough

/// The event loop of a window, as far as a view needs one: who waits, and who wakes.
class Wakes {
 public:
  void wake() {
    {
      const std::scoped_lock lock(mutex_);
      is_awake_ = true;
    }
    waking_.notify_one();
  }
  void wait(Clock::time_point until) {
    std::unique_lock lock(mutex_);
    waking_.wait_until(lock, until, [&] { return is_awake_; });
    is_awake_ = false;
  }

 private:
  std::mutex mutex_;  // guards is_awake_
  std::condition_variable waking_;
  bool is_awake_ = false;
};

/// What one position of the slider took.
struct Step {
  double tick_ms = 0.0;      ///< longest that a tick kept the thread of the window
  double frame_ms = 0.0;     ///< longest that a frame did
  double picture_ms = 0.0;   ///< from the slider to the picture of that instant, or a fair part of its points
  double complete_ms = 0.0;  ///< to all of it
};

bool isCloud(const scenegraph::ObjectStore& store, scenegraph::TopicId topic) {
  return store.topic(topic).type == scenegraph::ObjectType::PointCloud;
}

/// A view of the clouds of a recording as in the window: background work on a pool, frames with a budget.
class Scrubber {
 public:
  Scrubber(std::shared_ptr<scenegraph::Dataset> dataset, std::unique_ptr<scenegraph::OffscreenRenderer> renderer)
      : renderer_(std::move(renderer)),
        executor_(scenegraph::makeThreadPoolExecutor(std::max(2U, std::thread::hardware_concurrency()) - 1U)),
        scene_(std::move(dataset), nodes::layerTypes(), *executor_, [this] { wakes_.wake(); }) {
    const scenegraph::ObjectStore& store = scene_.dataset().store();
    for (scenegraph::TopicId topic = 0; topic < store.topicCount(); ++topic) {
      if (isCloud(store, topic)) {
        (void)scene_.addLayer(store.topic(topic).name);
      }
    }
  }

  Result<Step> go(tf::TimePoint time) {
    Step step;
    const Clock::time_point start = Clock::now();
    const Clock::time_point limit =
        start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(kLongestWaitS));
    const auto tick = [&] { step.tick_ms = std::max(step.tick_ms, 1e3 * secondsOf([&] { scene_.update(time); })); };
    tick();
    while (scene_.isPending() && Clock::now() < limit) {
      wakes_.wait(limit);
      tick();
    }
    if (!is_framed_) {
      frameAll();
    }
    double read_back_ms = 0.0;
    for (double share = 0.0; share < 1.0;) {
      const auto drawn = renderer_->render(scene_.root(), view_, {.point_limits = {.budget_ms = kScrubBudgetMs}});
      if (!drawn) {
        return failure(drawn.error().message);
      }
      const scenegraph::FrameStatistics& frame = renderer_->lastFrame();
      share = frame.points ? frame.points->share : 1.0;
      step.frame_ms = std::max(step.frame_ms, frame.frame_ms);
      read_back_ms += frame.read_back_ms;  // no part of a frame in a window
      const double passed_ms = scenegraph::millisecondsSince(start) - read_back_ms;
      step.picture_ms = step.picture_ms == 0.0 ? passed_ms : step.picture_ms;
      step.complete_ms = passed_ms;
    }
    return step;
  }
  [[nodiscard]] scenegraph::Scene& scene() noexcept { return scene_; }

 private:
  void frameAll() {
    const scenegraph::Box box = scene_.bulkInFixed();
    if (!box.isValid()) {
      return;
    }
    scenegraph::CameraRig rig;
    rig.change().frame(box, 16.0 / 9.0);
    view_ = rig.view();
    is_framed_ = true;
  }

  std::unique_ptr<scenegraph::OffscreenRenderer> renderer_;
  Wakes wakes_;
  std::unique_ptr<scenegraph::Executor> executor_;
  scenegraph::Scene scene_;
  scenegraph::CameraView view_;
  bool is_framed_ = false;
};

void report(std::vector<BenchResult>& results, const std::string& name, const std::vector<Step>& steps) {
  const auto line = [&](const char* what, double Step::* member, std::optional<double> at_most) {
    std::vector<double> values;
    for (const Step& step : steps) {
      values.push_back(step.*member);
    }
    std::ranges::sort(values);
    for (const auto& [title, part] : {std::pair("median", 0.5), std::pair("95 %", 0.95), std::pair("longest", 1.0)}) {
      results.push_back(
          {name + ", " + what + ", " + title, quantile(values, part), "ms", part == 1.0 ? at_most : std::nullopt});
    }
  };
  constexpr double kUnnoticed = 16.0;
  line("slider to picture", &Step::picture_ms, {});
  line("slider to all of it", &Step::complete_ms, {});
  line("tick, on the window's thread", &Step::tick_ms, kUnnoticed);
  line("frame, on the window's thread", &Step::frame_ms, 1.3 * kScrubBudgetMs);
}

/// The first instant at which every topic of clouds has a message; nullopt when none ever has.
std::optional<tf::TimePoint> firstInstant(const scenegraph::ObjectStore& store) {
  std::optional<tf::TimePoint> first;
  for (scenegraph::TopicId topic = 0; topic < store.topicCount(); ++topic) {
    const auto span = store.span(topic);
    if (span && isCloud(store, topic)) {
      first = first ? std::max(*first, span->first) : span->first;
    }
  }
  return first;
}

/// What the clouds of that instant cost to read and unpack, by a recording of its own, on as many threads as a window
/// has for it.
Result<double> readingMs(const RecordingOptions& options, tf::TimePoint time) {
  const auto executor = scenegraph::makeThreadPoolExecutor(std::max(2U, std::thread::hardware_concurrency()) - 1U);
  const Clock::time_point start = Clock::now();
  const auto recording = openRecording(options);
  if (!recording) {
    return std::unexpected(recording.error());
  }
  const scenegraph::ObjectStore& store = (*recording)->dataset()->store();
  for (scenegraph::TopicId topic = 0; topic < store.topicCount(); ++topic) {
    const auto entry = store.newestAtOrBefore(topic, time);
    if (entry && isCloud(store, topic)) {
      executor->submit([&store, topic, entry = *entry] { (void)store.decode(topic, entry); });
    }
  }
  executor->drain();
  return scenegraph::millisecondsSince(start);
}

/// The heap, less what was there before, once four more views have drawn that instant, each with a context of its own.
Result<double> heapOfViewsMib(const std::shared_ptr<scenegraph::Dataset>& dataset, tf::TimePoint time,
                              double before_mib) {
  std::vector<std::unique_ptr<Scrubber>> views;
  for (int i = 0; i < 4; ++i) {
    auto renderer = scenegraph::OffscreenRenderer::create();
    if (!renderer) {
      return failure(renderer.error().message);
    }
    views.push_back(std::make_unique<Scrubber>(dataset, std::move(*renderer)));
    if (const auto drawn = views.back()->go(time); !drawn) {
      return std::unexpected(drawn.error());
    }
  }
  return heapMib() - before_mib;
}

}  // namespace

Result<void> benchScrub(const RecordingOptions& options, std::vector<BenchResult>& results) {
  auto renderer = scenegraph::OffscreenRenderer::create();
  if (!renderer) {
    return failure(renderer.error().message);
  }
  // The file into the memory of the system, for all that follow alike.
  auto warm = openRecording(options);
  if (!warm) {
    return std::unexpected(warm.error());
  }
  const auto range = (*warm)->dataset()->timeRange();
  const auto first_time = firstInstant((*warm)->dataset()->store());
  if (!range || !first_time) {
    return failure(options.file + ": the recording holds no clouds");
  }
  if (const auto read = readingMs(options, *first_time); !read) {
    return std::unexpected(read.error());
  }
  const auto reading_ms = readingMs(options, *first_time);
  if (!reading_ms) {
    return std::unexpected(reading_ms.error());
  }
  warm->reset();
  const double heap_before_mib = heapMib();
  const Clock::time_point opening = Clock::now();
  auto recording = openRecording(options);
  if (!recording) {
    return std::unexpected(recording.error());
  }
  Scrubber scrubber((*recording)->dataset(), std::move(*renderer));
  if (const auto first = scrubber.go(*first_time); !first) {
    return std::unexpected(first.error());
  } else {
    const double opened_ms = scenegraph::millisecondsSince(opening) - first->complete_ms + first->picture_ms;
    results.push_back({"open to first picture", opened_ms, "ms"});
    results.push_back({"open, read and unpack the clouds of it", *reading_ms, "ms"});
    results.push_back({"open to first picture / reading", opened_ms / *reading_ms, "", 1.3});
    const double converted_mib = static_cast<double>((*recording)->dataset()->cache().bytes()) / (1024.0 * 1024.0);
    const double heap_mib = heapMib() - heap_before_mib;
    results.push_back({"converted clouds of the first picture", converted_mib, "MiB"});
    results.push_back({"heap of data, scene and picture", heap_mib, "MiB"});
    results.push_back({"heap / converted clouds", heap_mib / converted_mib, "", 1.5});
    const auto shared_mib = heapOfViewsMib((*recording)->dataset(), *first_time, heap_before_mib);
    if (!shared_mib) {
      return std::unexpected(shared_mib.error());
    }
    results.push_back({"heap / converted clouds, 4 views more", *shared_mib / converted_mib, "", 1.5});
  }
  const double span_ns = tf::secondsBetween(range->first, range->second) * 1e9;
  for (const char* const name : {"scrub, first visit", "scrub, again"}) {
    std::vector<Step> steps;
    const Clock::time_point begun = Clock::now();
    int turned_at = kPositions;
    for (int i = 0; i < 2 * turned_at; ++i) {
      if (turned_at == kPositions && scenegraph::millisecondsSince(begun) > 500.0 * kLongestRoundS) {
        turned_at = std::min(i, kPositions);
      }
      const int position = i < turned_at ? i : 2 * turned_at - 1 - i;  // there, and back
      const auto offset_ns = static_cast<std::int64_t>(span_ns * position / (kPositions - 1));
      const auto step = scrubber.go(std::min(range->second, tf::TimePoint{range->first.ns + offset_ns}));
      if (!step) {
        return std::unexpected(step.error());
      }
      steps.push_back(*step);
    }
    report(results, name, steps);
  }
  const std::size_t cached_bytes = (*recording)->dataset()->cache().bytes();
  results.push_back({"products kept for going back", static_cast<double>(cached_bytes) * 1e-6, "MB"});
  return {};
}

}  // namespace stillframe::cli
