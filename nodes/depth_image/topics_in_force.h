#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/store/object_store.h"

namespace stillframe::nodes {

/// The message of a topic that is in force at some time.
struct TopicInForce {
  scenegraph::TopicId id = 0;
  std::string name;
  scenegraph::Entry entry;
};

/// Topics of one type, the most akin by name to `akin` first, with what is in force on them. The list of topics is made
/// anew only when the store has more of them.
class TopicsInForce {
 public:
  TopicsInForce(scenegraph::ObjectType type, std::string akin) : type_(type), akin_(std::move(akin)) {}

  [[nodiscard]] std::vector<TopicInForce> at(const scenegraph::ObjectStore& store, tf::TimePoint time) {
    if (const std::size_t count = store.topicCount(); count != known_) {
      known_ = count;
      topics_.clear();
      for (scenegraph::TopicId id = 0; id < count; ++id) {
        scenegraph::TopicInfo info = store.topic(id);
        if (info.type == type_ && info.name != akin_) {
          topics_.push_back({id, std::move(info.name), {}});
        }
      }
      std::ranges::sort(topics_, [&](const TopicInForce& a, const TopicInForce& b) {
        const auto [near_a, near_b] = std::pair(likeness(a.name), likeness(b.name));
        return near_a != near_b ? near_a > near_b : a.name < b.name;
      });
    }
    std::vector<TopicInForce> found;
    for (const TopicInForce& topic : topics_) {
      if (const auto entry = store.newestAtOrBefore(topic.id, time)) {
        found.push_back({topic.id, topic.name, *entry});
      }
    }
    return found;
  }
  /// All of them, whether or not they have a message by now.
  [[nodiscard]] const std::vector<TopicInForce>& topics() const { return topics_; }

 private:
  /// Length of what the names have in common at their beginning.
  [[nodiscard]] std::size_t likeness(std::string_view name) const {
    return static_cast<std::size_t>(std::ranges::mismatch(name, akin_).in1 - name.begin());
  }

  scenegraph::ObjectType type_;
  std::string akin_;
  std::size_t known_ = 0;
  std::vector<TopicInForce> topics_;
};

/// Names a join in the cache: which messages took part in it.
[[nodiscard]] inline std::string joinText(const std::vector<TopicInForce>& topics) {
  std::string text;
  for (const TopicInForce& topic : topics) {
    text += "|" + std::to_string(topic.id) + ":" + std::to_string(topic.entry.sequence);
  }
  return text;
}

}  // namespace stillframe::nodes
