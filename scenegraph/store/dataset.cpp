#include "scenegraph/store/dataset.h"

#include <algorithm>
#include <map>
#include <mutex>

#include "scenegraph/store/transform_loader.h"

namespace stillframe::scenegraph {

struct Dataset::Impl {
  Impl(const ObjectStore& store, tf::TransformBuffer& buffer) : loader(store, buffer) {}

  std::mutex load_mutex;  // held while transforms are taken: guards loader
  TransformLoader loader;

  std::mutex mutex;  // guards everything below; never held while decoding
  TfClock clock = TfClock::Auto;
  TfClock clock_in_use = TfClock::Header;
  std::optional<std::pair<tf::TimePoint, tf::TimePoint>> known_range;
  std::vector<Problem> recorded;
  std::map<std::pair<std::string, std::string>, std::size_t> recorded_index;
  std::uint64_t unlisted = 0;
  std::vector<Problem> of_transforms;

  /// With load_mutex held: makes what the loader found out visible.
  void publish() {
    std::vector<Problem> found = loader.problems();
    const std::scoped_lock lock(mutex);
    of_transforms = std::move(found);
    clock_in_use = loader.usesLogTime() ? TfClock::Log : TfClock::Header;
  }
};

Dataset::Dataset(std::string name)
    : name_(std::move(name)),
      transforms_(std::make_shared<tf::TransformBuffer>()),
      impl_(std::make_unique<Impl>(store_, *transforms_)) {}

Dataset::~Dataset() = default;

void Dataset::takeTransforms(const std::function<bool(std::uint64_t, std::uint64_t)>& progress) {
  const std::scoped_lock lock(impl_->load_mutex);
  impl_->loader.take(progress);
  impl_->publish();
}

void Dataset::setTfClock(TfClock clock) {
  const std::scoped_lock load_lock(impl_->load_mutex);
  {
    const std::scoped_lock lock(impl_->mutex);
    if (impl_->clock == clock) {
      return;
    }
    impl_->clock = clock;
  }
  impl_->loader.setUseLogTime(clock == TfClock::Auto ? std::nullopt : std::optional(clock == TfClock::Log));
  impl_->publish();
}

TfClock Dataset::tfClock() const {
  const std::scoped_lock lock(impl_->mutex);
  return impl_->clock;
}

TfClock Dataset::tfClockInUse() const {
  const std::scoped_lock lock(impl_->mutex);
  return impl_->clock_in_use;
}

std::optional<std::pair<tf::TimePoint, tf::TimePoint>> Dataset::timeRange() const {
  std::optional<std::pair<tf::TimePoint, tf::TimePoint>> range;
  {
    const std::scoped_lock lock(impl_->mutex);
    range = impl_->known_range;
  }
  const std::size_t topics = store_.topicCount();
  for (TopicId topic = 0; topic < topics; ++topic) {
    if (const auto span = store_.span(topic)) {
      range = range ? std::pair(std::min(range->first, span->first), std::max(range->second, span->second)) : *span;
    }
  }
  return range;
}

void Dataset::setTimeRange(tf::TimePoint first, tf::TimePoint last) {
  const std::scoped_lock lock(impl_->mutex);
  impl_->known_range = std::minmax(first, last);
}

void Dataset::addProblem(const Problem& problem) {
  constexpr std::size_t kMaxListed = 1024;
  const std::scoped_lock lock(impl_->mutex);
  const std::pair key(problem.code, problem.message);
  if (const auto found = impl_->recorded_index.find(key); found != impl_->recorded_index.end()) {
    impl_->recorded[found->second].count += problem.count;
  } else if (impl_->recorded.size() < kMaxListed) {
    impl_->recorded_index.emplace(key, impl_->recorded.size());
    impl_->recorded.push_back(problem);
  } else {
    impl_->unlisted += problem.count;
  }
}

std::vector<Problem> Dataset::problems() const {
  const std::scoped_lock lock(impl_->mutex);
  std::vector<Problem> all = impl_->recorded;
  if (impl_->unlisted > 0) {
    all.push_back({"MoreProblems", "further problems that are not listed", impl_->unlisted});
  }
  all.insert(all.end(), impl_->of_transforms.begin(), impl_->of_transforms.end());
  return all;
}

}  // namespace stillframe::scenegraph
