#include "scenegraph/store/object_store.h"

#include <algorithm>
#include <exception>
#include <mutex>

namespace stillframe::scenegraph {
namespace {

bool isBefore(const Entry& a, const Entry& b) {
  return a.log_time != b.log_time ? a.log_time < b.log_time : a.sequence < b.sequence;
}

/// First entry later than `t`.
auto firstAfter(const std::vector<Entry>& entries, tf::TimePoint t) {
  return std::upper_bound(entries.begin(), entries.end(), t,
                          [](tf::TimePoint time, const Entry& entry) { return time < entry.log_time; });
}

}  // namespace

TopicId ObjectStore::addTopic(TopicInfo info, std::shared_ptr<const EntrySource> source) {
  TopicId id = 0;
  {
    const std::unique_lock lock(mutex_);
    for (; id < topics_.size(); ++id) {
      if (topics_[id].info->name == info.name && topics_[id].info->type == info.type) {
        return id;
      }
    }
    topics_.push_back(TopicData{.info = std::make_shared<const TopicInfo>(std::move(info)),
                                .source = std::move(source),
                                .entries = {},
                                .is_in_arrival_order = true});
    revision_.fetch_add(1, std::memory_order_release);
  }
  notify(id);
  return id;
}

void ObjectStore::append(TopicId topic, std::span<const Entry> entries) {
  if (entries.empty()) {
    return;
  }
  {
    const std::unique_lock lock(mutex_);
    if (topic >= topics_.size()) {
      return;
    }
    TopicData& data = topics_[topic];
    const auto old_size = static_cast<std::ptrdiff_t>(data.entries.size());
    for (const Entry& entry : entries) {
      data.entries.push_back(entry);
      data.entries.back().sequence = next_sequence_++;
    }
    const auto added = data.entries.begin() + old_size;
    if (!std::is_sorted(added, data.entries.end(), isBefore)) {
      data.is_in_arrival_order = false;
      std::sort(added, data.entries.end(), isBefore);
    }
    if (old_size > 0 && isBefore(*added, *(added - 1))) {
      data.is_in_arrival_order = false;
      std::inplace_merge(std::upper_bound(data.entries.begin(), added, *added, isBefore), added, data.entries.end(),
                         isBefore);
    }
    revision_.fetch_add(1, std::memory_order_release);
  }
  notify(topic);
}

void ObjectStore::notify(TopicId topic) {
  std::vector<std::shared_ptr<std::function<void(TopicId)>>> told;
  {
    const std::unique_lock lock(mutex_);
    std::erase_if(listeners_, [&](const std::weak_ptr<std::function<void(TopicId)>>& weak) {
      auto listener = weak.lock();
      if (listener == nullptr) {
        return true;
      }
      told.push_back(std::move(listener));
      return false;
    });
  }
  for (const auto& listener : told) {
    (*listener)(topic);
  }
}

std::size_t ObjectStore::topicCount() const {
  const std::shared_lock lock(mutex_);
  return topics_.size();
}

TopicInfo ObjectStore::topic(TopicId topic) const {
  const std::shared_lock lock(mutex_);
  return topic < topics_.size() ? *topics_[topic].info : TopicInfo{};
}

std::optional<TopicId> ObjectStore::findTopic(std::string_view name, std::optional<ObjectType> type) const {
  const std::shared_lock lock(mutex_);
  for (TopicId id = 0; id < topics_.size(); ++id) {
    if (topics_[id].info->name == name && (!type || topics_[id].info->type == *type)) {
      return id;
    }
  }
  return std::nullopt;
}

std::size_t ObjectStore::entryCount(TopicId topic) const {
  const std::shared_lock lock(mutex_);
  return topic < topics_.size() ? topics_[topic].entries.size() : 0;
}

std::optional<Entry> ObjectStore::newestAtOrBefore(TopicId topic, tf::TimePoint t) const {
  const std::shared_lock lock(mutex_);
  if (topic >= topics_.size()) {
    return std::nullopt;
  }
  const std::vector<Entry>& entries = topics_[topic].entries;
  const auto after = firstAfter(entries, t);
  return after == entries.begin() ? std::nullopt : std::optional(*(after - 1));
}

std::size_t ObjectStore::countAtOrBefore(TopicId topic, tf::TimePoint t) const {
  const std::shared_lock lock(mutex_);
  if (topic >= topics_.size()) {
    return 0;
  }
  const std::vector<Entry>& entries = topics_[topic].entries;
  return static_cast<std::size_t>(firstAfter(entries, t) - entries.begin());
}

std::vector<Entry> ObjectStore::range(TopicId topic, std::optional<tf::TimePoint> after, tf::TimePoint upto) const {
  const std::shared_lock lock(mutex_);
  if (topic >= topics_.size()) {
    return {};
  }
  const std::vector<Entry>& entries = topics_[topic].entries;
  const auto begin = after ? firstAfter(entries, *after) : entries.begin();
  const auto end = firstAfter(entries, upto);
  return begin < end ? std::vector<Entry>(begin, end) : std::vector<Entry>();
}

std::optional<Entry> ObjectStore::at(TopicId topic, std::size_t index) const {
  const std::shared_lock lock(mutex_);
  if (topic >= topics_.size() || index >= topics_[topic].entries.size()) {
    return std::nullopt;
  }
  return topics_[topic].entries[index];
}

std::vector<Entry> ObjectStore::arrivedSince(TopicId topic, std::uint64_t sequence) const {
  const std::shared_lock lock(mutex_);
  if (topic >= topics_.size()) {
    return {};
  }
  const TopicData& data = topics_[topic];
  const auto is_new = [&](const Entry& entry) { return entry.sequence >= sequence; };
  if (data.is_in_arrival_order) {
    return {std::find_if_not(data.entries.rbegin(), data.entries.rend(), is_new).base(), data.entries.end()};
  }
  std::vector<Entry> found;
  std::copy_if(data.entries.begin(), data.entries.end(), std::back_inserter(found), is_new);
  return found;
}

std::optional<std::pair<tf::TimePoint, tf::TimePoint>> ObjectStore::span(TopicId topic) const {
  const std::shared_lock lock(mutex_);
  if (topic >= topics_.size() || topics_[topic].entries.empty()) {
    return std::nullopt;
  }
  return std::pair(topics_[topic].entries.front().log_time, topics_[topic].entries.back().log_time);
}

std::pair<std::shared_ptr<const TopicInfo>, std::shared_ptr<const EntrySource>> ObjectStore::decoderOf(
    TopicId topic) const {
  const std::shared_lock lock(mutex_);
  return topic < topics_.size() ? std::pair(topics_[topic].info, topics_[topic].source)
                                : std::pair<std::shared_ptr<const TopicInfo>, std::shared_ptr<const EntrySource>>{};
}

std::optional<EarlyObject> ObjectStore::decodeEarly(TopicId topic, const Entry& entry) const {
  const auto [info, source] = decoderOf(topic);
  try {
    auto early = source == nullptr ? std::nullopt : source->decodeEarly(*info, entry);
    if (early && early->writer != nullptr) {
      using Writer = std::pair<std::shared_ptr<const EntrySource>, std::shared_ptr<void>>;  // the latter goes first
      early->writer = std::make_shared<Writer>(source, std::move(early->writer));
    }
    return early;
  } catch (const std::exception&) {
    return std::nullopt;  // decode() says why
  }
}

std::expected<AnyObject, DecodeError> ObjectStore::decode(TopicId topic, const Entry& entry) const {
  const auto [info, source] = decoderOf(topic);
  if (source == nullptr) {
    return std::unexpected(DecodeError{"NoDecoder", "the topic has no decoder"});
  }
  try {
    return source->decode(*info, entry);
  } catch (const std::exception& error) {
    return std::unexpected(DecodeError{"DecodeFailed", std::string("the decoder gave up: ") + error.what()});
  }
}

std::uint64_t ObjectStore::revision() const noexcept { return revision_.load(std::memory_order_acquire); }

std::shared_ptr<void> ObjectStore::listen(std::function<void(TopicId)> listener) {
  auto token = std::make_shared<std::function<void(TopicId)>>(std::move(listener));
  const std::unique_lock lock(mutex_);
  listeners_.push_back(token);
  return token;
}

}  // namespace stillframe::scenegraph
