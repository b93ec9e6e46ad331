#include "tools/cli/bench_view.h"

#include <algorithm>
#include <semaphore>
#include <thread>
#include <utility>

#include "nodes/registry.h"
#include "scenegraph/camera/camera_rig.h"
#include "scenegraph/stopwatch.h"
#include "tools/cli/bench_results.h"

namespace stillframe::cli {

using Clock = std::chrono::steady_clock;

void BenchView::Wakes::wake() {
  {
    const std::scoped_lock lock(mutex_);
    is_awake_ = true;
  }
  waking_.notify_one();
}

void BenchView::Wakes::wait(Clock::time_point until) {
  std::unique_lock lock(mutex_);
  waking_.wait_until(lock, until, [&] { return is_awake_; });
  is_awake_ = false;
}

BenchView::BenchView(std::shared_ptr<scenegraph::Dataset> dataset,
                     std::unique_ptr<scenegraph::OffscreenRenderer> renderer)
    : renderer_(std::move(renderer)),
      wakes_(std::make_shared<Wakes>()),
      executor_(scenegraph::makeThreadPoolExecutor(std::max(2U, std::thread::hardware_concurrency()) - 1U)),
      scene_(std::move(dataset), nodes::layerTypes(), *executor_, requester()) {
  const scenegraph::ObjectStore& store = scene_.dataset().store();
  for (scenegraph::TopicId topic = 0; topic < store.topicCount(); ++topic) {
    if (isCloud(store, topic)) {
      (void)scene_.addLayer(store.topic(topic).name);
    }
  }
}

std::function<void()> BenchView::requester() const {
  return [wakes = wakes_] { wakes->wake(); };
}

std::vector<std::string> BenchView::statusCodes() const {
  std::vector<std::string> codes;
  for (const auto& slot : scene_.layers()) {
    codes.push_back(slot->layer->status().code);
  }
  return codes;
}

Result<BenchStep> BenchView::go(tf::TimePoint time, const std::function<bool()>& is_there) {
  constexpr std::chrono::seconds kLongestWait(20);
  BenchStep step;
  const Clock::time_point start = Clock::now();
  const Clock::time_point limit = start + kLongestWait;
  const auto tick = [&] { step.tick_ms = std::max(step.tick_ms, 1e3 * secondsOf([&] { scene_.update(time); })); };
  tick();
  while ((scene_.isPending() || (is_there && !is_there())) && Clock::now() < limit) {
    wakes_->wait(limit);
    tick();
  }
  if (!is_framed_) {
    frameAll();
  }
  for (double share = 0.0; share < 1.0;) {
    if (const auto drawn = draw(); !drawn) {
      return std::unexpected(drawn.error());
    }
    const scenegraph::FrameStatistics& frame = renderer_->lastFrame();
    share = frame.points ? frame.points->share : 1.0;
    step.frame_ms = std::max(step.frame_ms, frame.frame_ms);
    step.stall_ms = std::max(step.stall_ms, frame.step_ms);
    const double passed_ms = scenegraph::millisecondsSince(start);
    step.picture_ms = step.picture_ms == 0.0 ? passed_ms : step.picture_ms;
    step.complete_ms = passed_ms;
  }
  return step;
}

Result<void> BenchView::draw() {
  const auto drawn = renderer_->show(scene_.root(), view_, {.point_limits = {.budget_ms = kBudgetMs}});
  return drawn ? Result<void>{} : failure(drawn.error().message);
}

void BenchView::rest() {
  executor_->drain();  // spare jobs wait for the others, and come one after the other
  const auto is_resting = std::make_shared<std::binary_semaphore>(0);
  executor_->submitSpare([is_resting] { is_resting->release(); });
  is_resting->acquire();
}

void BenchView::frameAll() {
  const scenegraph::Box box = scene_.bulkInFixed();
  if (!box.isValid()) {
    return;
  }
  scenegraph::CameraRig rig;
  rig.change().frame(box, 16.0 / 9.0);
  view_ = rig.view();
  is_framed_ = true;
}

bool isCloud(const scenegraph::ObjectStore& store, scenegraph::TopicId topic) {
  return store.topic(topic).type == scenegraph::ObjectType::PointCloud;
}

std::optional<tf::TimePoint> firstCloudInstant(const scenegraph::ObjectStore& store) {
  std::optional<tf::TimePoint> first;
  for (scenegraph::TopicId topic = 0; topic < store.topicCount(); ++topic) {
    const auto span = store.span(topic);
    if (span && isCloud(store, topic)) {
      first = first ? std::max(*first, span->first) : span->first;
    }
  }
  return first;
}

}  // namespace stillframe::cli
