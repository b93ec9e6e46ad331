#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "nodes/robots/joint_poses.h"
#include "scenegraph/layer.h"
#include "scenegraph/sample_loader.h"

namespace stillframe::nodes {

/// Joint positions in force at a message: its own, and those that the messages of the second before it tell of other
/// joints, since an arm and its gripper often report apart on one topic.
struct JointSample {
  JointPositions positions;
  [[nodiscard]] std::size_t byteSize() const { return sizeof(*this) + positions.size() * 96; }
};

/// The joint states that belong to a robot. GUI thread.
class JointFeed {
 public:
  explicit JointFeed(const scenegraph::LayerContext& context) : context_(context) {}

  /// Moves to `time`. `chosen` is a topic or "auto": the topic of joint states in the same namespace as `robot_topic`,
  /// else one that is named joint_states, else the first.
  void update(tf::TimePoint time, const std::string& chosen, const std::string& robot_topic);

  /// nullptr when there is none (yet); status() says why.
  [[nodiscard]] const JointSample* sample() const;
  /// "" when the recording has no joint states.
  [[nodiscard]] const std::string& topic() const noexcept { return topic_; }
  [[nodiscard]] scenegraph::Status status() const { return loader_ ? loader_->status() : scenegraph::Status{}; }
  [[nodiscard]] bool isPending() const { return loader_ && loader_->isPending(); }

 private:
  [[nodiscard]] std::string chooseTopic(const std::string& chosen, const std::string& robot_topic) const;

  scenegraph::LayerContext context_;
  std::string topic_;
  std::optional<std::uint64_t> known_revision_;  // of the store, that topic_ was chosen at
  std::string known_choice_;
  std::optional<scenegraph::SampleLoader<JointSample>> loader_;
};

}  // namespace stillframe::nodes
