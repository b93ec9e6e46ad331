#include "nodes/occupancy_grid/grid_tracker.h"

#include <expected>
#include <mutex>
#include <vector>

#include "scenegraph/store/tf_clock.h"

namespace stillframe::nodes {
namespace {

using scenegraph::CacheKey;
using scenegraph::Dataset;
using scenegraph::Entry;
using scenegraph::ObjectStore;
using scenegraph::ObjectType;
using scenegraph::OccupancyGrid;
using scenegraph::OccupancyGridUpdate;
using scenegraph::Status;
using scenegraph::StatusLevel;
using scenegraph::timeText;
using scenegraph::TopicId;

constexpr std::string_view kSuffix = "_updates";

/// A base and all that follows from it, as the cache holds it; or why there is nothing.
struct Shelf {
  explicit Shelf(std::expected<GridHistory, Status> made) : history(std::move(made)) {}
  mutable std::mutex mutex;  // guards history
  mutable std::expected<GridHistory, Status> history;
};

/// What a worker needs; by value.
struct Work {
  std::shared_ptr<Dataset> dataset;
  std::string name;
  TopicId base_topic = 0;
  Entry base;
  std::optional<TopicId> updates_topic;
  tf::TimePoint until;
};

std::expected<GridHistory, Status> makeHistory(const Work& work) {
  const auto fail = [&](const Status& status) {
    return std::unexpected(Status{status.level, status.code,
                                  "'" + work.name + "' at " + timeText(work.base.log_time) + ": " + status.message});
  };
  const auto object = work.dataset->store().decode(work.base_topic, work.base);
  if (!object) {
    return fail({StatusLevel::Error, object.error().code, object.error().message});
  }
  const auto grid = object->get<OccupancyGrid>();
  if (grid == nullptr) {
    return fail({StatusLevel::Error, "WrongObject", "the decoder made another object than the topic announces"});
  }
  auto header = checkGrid(*grid);
  if (!header) {
    return fail(header.error());
  }
  return GridHistory(std::move(*header), grid->data.bytes);
}

scenegraph::LatestJob<GridSnapshot>::Result run(const Work& work) {
  const ObjectStore& store = work.dataset->store();
  const CacheKey key = scenegraph::cacheKey(work.base_topic, work.base, "grid_history");
  auto shelf = work.dataset->cache().get<Shelf>(key);
  if (shelf == nullptr) {
    shelf = std::make_shared<const Shelf>(makeHistory(work));
  }
  const std::scoped_lock lock(shelf->mutex);
  if (!shelf->history) {
    work.dataset->cache().put(key, shelf, sizeof(Shelf) + shelf->history.error().message.size());
    return std::unexpected(shelf->history.error());
  }
  GridHistory& history = *shelf->history;
  std::vector<Entry> entries;
  if (work.updates_topic) {
    entries = store.range(*work.updates_topic, work.base.log_time, work.until);
  }
  std::vector<std::uint64_t> ids;
  ids.reserve(entries.size());
  for (const Entry& entry : entries) {
    ids.push_back(entry.sequence);
  }
  auto snapshot = std::make_shared<GridSnapshot>();
  snapshot->header = history.header();
  snapshot->base = work.base;
  snapshot->state = history.at(ids, [&](std::size_t place) -> GridHistory::Update {
    const auto object = store.decode(*work.updates_topic, entries[place]);
    return object ? object->get<OccupancyGridUpdate>() : nullptr;
  });
  work.dataset->cache().put(key, shelf, history.byteSize());
  return snapshot;
}

}  // namespace

std::string baseTopicOf(std::string_view updates_topic) {
  return updates_topic.size() > kSuffix.size() && updates_topic.ends_with(kSuffix)
             ? std::string(updates_topic.substr(0, updates_topic.size() - kSuffix.size()))
             : std::string();
}

bool isOrphan(const ObjectStore& store, std::string_view topic) {
  return store.findTopic(topic, ObjectType::OccupancyGridUpdate) &&
         !store.findTopic(baseTopicOf(topic), ObjectType::OccupancyGrid);
}

GridTracker::GridTracker(const scenegraph::LayerContext& context, std::string topic)
    : dataset_(context.dataset.shared_from_this()),
      name_(std::move(topic)),
      job_(context.executor, context.request_update) {}

void GridTracker::findTopics() {
  const ObjectStore& store = dataset_->store();
  const std::size_t count = store.topicCount();
  if (count != topics_looked_at_ || count == 0) {
    topics_looked_at_ = count;
    base_topic_ = store.findTopic(name_, ObjectType::OccupancyGrid);
    updates_topic_ = store.findTopic(name_ + std::string(kSuffix), ObjectType::OccupancyGridUpdate);
  }
}

bool GridTracker::update(tf::TimePoint time) {
  findTopics();
  const ObjectStore& store = dataset_->store();
  const auto base = base_topic_ ? store.newestAtOrBefore(*base_topic_, time) : std::nullopt;
  if (!base) {
    job_.cancel();
    shown_key_.reset();
    return show(nullptr, nothing(time));
  }
  CacheKey key = scenegraph::cacheKey(*base_topic_, *base, "grid");
  Work work{dataset_, name_, *base_topic_, *base, updates_topic_, base->log_time};
  const auto last = updates_topic_ ? store.newestAtOrBefore(*updates_topic_, time) : std::nullopt;
  if (last && last->log_time > base->log_time) {
    // Updates between the two only ever become more: their number and the last one tell which they are.
    const std::uint64_t count =
        store.countAtOrBefore(*updates_topic_, last->log_time) - store.countAtOrBefore(*updates_topic_, base->log_time);
    key.product += ":" + std::to_string(count) + ":" + std::to_string(last->sequence);
    work.until = last->log_time;
  }
  if (shown_key_ == key) {
    job_.cancel();
    return show(product_, shown_status_);
  }
  job_.request(key, [work = std::move(work)] { return run(work); });
  auto outcome = job_.take();
  if (!outcome) {
    return show(product_,
                {StatusLevel::Warn, "Decoding",
                 "the grid of " + timeText(base->log_time) + " on '" + name_ + "' and its updates are being decoded" +
                     (product_ != nullptr ? "; the state before is shown meanwhile" : "")});
  }
  shown_key_ = key;
  shown_status_ = outcome->result ? Status{} : outcome->result.error();
  return show(outcome->result ? *outcome->result : nullptr, shown_status_);
}

Status GridTracker::nothing(tf::TimePoint time) const {
  const ObjectStore& store = dataset_->store();
  if (!base_topic_) {
    const std::string base = baseTopicOf(name_);
    if (store.findTopic(name_, ObjectType::OccupancyGridUpdate)) {
      return isOrphan(store, name_) ? Status{StatusLevel::Warn, "UpdateWithoutBase",
                                             "'" + name_ + "' carries updates of a grid that is not there: " +
                                                 (base.empty() ? "no topic belongs to a name without '_updates'"
                                                               : "there is no OccupancyGrid on '" + base + "'")}
                                    : Status{StatusLevel::Info, "UpdatesOfBase",
                                             "the updates on '" + name_ + "' are drawn with '" + base + "'"};
    }
    return {StatusLevel::Warn, "NoTopic", "there is no topic '" + name_ + "' of type OccupancyGrid"};
  }
  const auto span = store.span(*base_topic_);
  const std::string first = span ? ": the first is at " + timeText(span->first) : "";
  if (updates_topic_ && store.newestAtOrBefore(*updates_topic_, time)) {
    return {StatusLevel::Warn, "UpdateBeforeBase",
            "there are updates on '" + name_ + std::string(kSuffix) + "' but no grid on '" + name_ + "' at or before " +
                timeText(time) + first};
  }
  return {
      StatusLevel::Warn, "NoMessage",
      span ? "no message on '" + name_ + "' at or before " + timeText(time) + first : "no message on '" + name_ + "'"};
}

bool GridTracker::show(std::shared_ptr<const GridSnapshot> product, Status status) {
  const bool has_changed = product != product_ || status != status_;
  product_ = std::move(product);
  status_ = std::move(status);
  return has_changed;
}

}  // namespace stillframe::nodes
