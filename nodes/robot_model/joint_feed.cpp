#include "nodes/robot_model/joint_feed.h"

#include <expected>
#include <limits>
#include <ranges>
#include <utility>
#include <vector>

#include "scenegraph/objects/robot_description.h"

namespace stillframe::nodes {
namespace {

using scenegraph::AnyObject;
using scenegraph::Dataset;
using scenegraph::Entry;
using scenegraph::JointStates;
using scenegraph::ObjectType;
using scenegraph::TopicId;

constexpr std::int64_t kLookBack_ns = 1'000'000'000;
constexpr int kMostMessages = 16;
constexpr int kMostWithoutNews = 4;

/// Adds what the messages just before `entry` tell of joints that it does not name.
void addEarlier(const Dataset& dataset, TopicId topic, const Entry& entry, JointPositions& positions) {
  const std::int64_t earliest = std::numeric_limits<std::int64_t>::min();
  const tf::TimePoint after{entry.log_time.ns < earliest + kLookBack_ns ? earliest : entry.log_time.ns - kLookBack_ns};
  const std::vector<Entry> before = dataset.store().range(topic, after, entry.log_time);
  int looked = 0;
  int without_news = 0;
  for (const Entry& earlier : std::views::reverse(before)) {
    if (earlier.log_time == entry.log_time && earlier.sequence >= entry.sequence) {
      continue;
    }
    if (++looked > kMostMessages || without_news >= kMostWithoutNews) {
      return;
    }
    const auto object = dataset.store().decode(topic, earlier);
    const auto states = object ? object->get<JointStates>() : nullptr;
    const std::size_t known = positions.size();
    if (states != nullptr) {
      positions.merge(jointPositions(*states));  // keeps the newer
    }
    without_news = positions.size() == known ? without_news + 1 : 0;
  }
}

std::string_view namespaceOf(std::string_view topic) { return topic.substr(0, topic.find_last_of('/') + 1); }

}  // namespace

std::string JointFeed::chooseTopic(const std::string& chosen, const std::string& robot_topic) const {
  if (chosen != "auto") {
    return chosen;
  }
  const scenegraph::ObjectStore& store = context_.dataset.store();
  std::string best;
  int best_rank = 0;
  for (TopicId id = 0; id < store.topicCount(); ++id) {
    const scenegraph::TopicInfo topic = store.topic(id);
    if (topic.type != ObjectType::JointStates) {
      continue;
    }
    const bool is_named = topic.name.ends_with("joint_states");
    const bool is_beside = namespaceOf(topic.name) == namespaceOf(robot_topic);
    const int rank = 1 + (is_named ? 1 : 0) + (is_beside ? 2 : 0);
    if (rank > best_rank || (rank == best_rank && topic.name < best)) {
      best = topic.name;
      best_rank = rank;
    }
  }
  return best;
}

void JointFeed::update(tf::TimePoint time, const std::string& chosen, const std::string& robot_topic) {
  const std::uint64_t revision = context_.dataset.store().revision();
  if (known_revision_ != revision || known_choice_ != chosen) {
    known_revision_ = revision;
    known_choice_ = chosen;
    std::string topic = chooseTopic(chosen, robot_topic);
    if (topic != topic_ || (!loader_ && !topic.empty())) {
      loader_.reset();
      topic_ = std::move(topic);
      if (!topic_.empty()) {
        loader_.emplace(
            context_, ObjectType::JointStates, topic_, "joint positions",
            [dataset = context_.dataset.shared_from_this(), name = topic_](
                const AnyObject& object, const Entry& entry) -> std::expected<JointSample, scenegraph::Status> {
              JointSample sample{jointPositions(*object.get<JointStates>())};
              if (const auto id = dataset->store().findTopic(name, ObjectType::JointStates)) {
                addEarlier(*dataset, *id, entry, sample.positions);
              }
              return sample;
            });
      }
    }
  }
  if (loader_) {
    (void)loader_->update(time);
  }
}

const JointSample* JointFeed::sample() const { return loader_ ? loader_->product().get() : nullptr; }

}  // namespace stillframe::nodes
