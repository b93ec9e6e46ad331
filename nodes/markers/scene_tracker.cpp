#include "nodes/markers/scene_tracker.h"

#include <mutex>
#include <utility>

#include "nodes/markers/scene_history.h"
#include "scenegraph/store/tf_clock.h"

namespace stillframe::nodes {
namespace {

using scenegraph::CacheKey;
using scenegraph::ObjectStore;
using scenegraph::SceneEntities;
using scenegraph::Status;
using scenegraph::StatusLevel;
using scenegraph::timeText;
using scenegraph::TopicId;

/// The history as the cache holds it.
struct Shelf {
  mutable std::mutex mutex;  // guards history
  mutable SceneHistory history;
};

SceneMessage fetch(const ObjectStore& store, TopicId topic, std::size_t place) {
  const auto entry = store.at(topic, place);
  if (!entry) {
    return {{}, 0, 0, std::unexpected(scenegraph::DecodeError{"NoMessage", "the message is gone"})};
  }
  SceneMessage message{entry->log_time, entry->sequence, entry->payload_bytes, nullptr};
  if (auto object = store.decode(topic, *entry)) {
    message.scene = object->get<SceneEntities>();
  } else {
    message.scene = std::unexpected(object.error());
  }
  return message;
}

scenegraph::LatestJob<SceneState>::Result run(scenegraph::Dataset& dataset, TopicId topic, std::size_t count,
                                              tf::TimePoint time) {
  const ObjectStore& store = dataset.store();
  const CacheKey key{topic, 0, 0, 0, "scene_history"};
  auto shelf = dataset.cache().get<Shelf>(key);
  if (shelf == nullptr) {
    shelf = std::make_shared<const Shelf>();
  }
  const std::scoped_lock lock(shelf->mutex);
  auto state = std::make_shared<const SceneState>(shelf->history.at(
      count, time,
      [&](std::size_t place) {
        const auto entry = store.at(topic, place);
        return entry ? entry->sequence : 0;
      },
      [&](std::size_t place) { return fetch(store, topic, place); }));
  dataset.cache().put(key, shelf, shelf->history.byteSize() + state->totals.bytes);
  if (state->failure) {
    return std::unexpected(Status{StatusLevel::Error, state->failure->code, state->failure->message});
  }
  return state;
}

}  // namespace

SceneTracker::SceneTracker(const scenegraph::LayerContext& context, std::string topic)
    : dataset_(context.dataset.shared_from_this()),
      name_(std::move(topic)),
      job_(context.executor, context.request_update) {}

void SceneTracker::reset() {
  job_.cancel();
  shown_.reset();
  product_ = nullptr;
}

void SceneTracker::update(tf::TimePoint time) {
  const ObjectStore& store = dataset_->store();
  if (!topic_) {
    topic_ = store.findTopic(name_, scenegraph::ObjectType::SceneEntities);
  }
  const std::size_t count = topic_ ? store.countAtOrBefore(*topic_, time) : 0;
  const auto last = count > 0 ? store.at(*topic_, count - 1) : std::nullopt;
  if (!last) {
    reset();
    const auto span = topic_ ? store.span(*topic_) : std::nullopt;
    status_ = {StatusLevel::Warn, topic_ ? "NoMessage" : "NoTopic",
               !topic_ ? "there is no topic '" + name_ + "' of type SceneEntities"
               : span  ? "no message on '" + name_ + "' at or before " + timeText(time) + ": the first is at " +
                            timeText(span->first)
                      : "no message on '" + name_ + "'"};
    return;
  }
  const Inputs inputs{count, last->sequence};
  if (shown_ == inputs && (product_ == nullptr || (product_->last_expiry <= time && time < product_->next_expiry))) {
    job_.cancel();
    status_ = shown_status_;
    return;
  }
  CacheKey key = scenegraph::cacheKey(*topic_, *last, "scene:");
  key.product += std::to_string(count) + ":" + std::to_string(time.ns);
  job_.request(key, [dataset = dataset_, topic = *topic_, count, time] { return run(*dataset, topic, count, time); });
  auto outcome = job_.take();
  if (!outcome) {
    status_ = {StatusLevel::Warn, "Decoding",
               "the " + std::to_string(count) + " messages on '" + name_ + "' up to " + timeText(last->log_time) +
                   " are being decoded" + (product_ != nullptr ? "; the state before is shown meanwhile" : "")};
    return;
  }
  product_ = outcome->result ? *outcome->result : nullptr;
  shown_ = inputs;
  shown_status_ = {};
  if (!outcome->result) {
    shown_status_ = outcome->result.error();
    shown_status_.message = "'" + name_ + "' at " + timeText(last->log_time) + ": " + shown_status_.message;
  }
  status_ = shown_status_;
}

}  // namespace stillframe::nodes
