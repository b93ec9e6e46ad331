#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "nodes/markers/scene_state.h"
#include "scenegraph/latest_job.h"
#include "scenegraph/layer.h"
#include "scenegraph/status.h"
#include "scenegraph/store/dataset.h"

namespace stillframe::nodes {

/// Brings the entities of a topic to a tick, off the GUI thread.
///
/// As SampleLoader does for types whose messages stand alone: latest wins, the state before stays meanwhile and
/// status() says so. The history lies in the dataset's cache, shared by all views. GUI thread only.
class SceneTracker {
 public:
  SceneTracker(const scenegraph::LayerContext& context, std::string topic);

  /// Costs two binary searches when the state shown still holds.
  void update(tf::TimePoint time);
  /// What to draw; nullptr when there is nothing.
  [[nodiscard]] const std::shared_ptr<const SceneState>& product() const noexcept { return product_; }
  /// Ok; NoTopic, NoMessage; Decoding; or why the newest message could not be read: nothing is drawn then.
  [[nodiscard]] const scenegraph::Status& status() const noexcept { return status_; }
  [[nodiscard]] bool isPending() const { return job_.isPending(); }
  /// Forgets what is shown.
  void reset();

 private:
  /// What a state was made of.
  struct Inputs {
    std::size_t count = 0;
    std::uint64_t last_sequence = 0;
    friend bool operator==(const Inputs&, const Inputs&) = default;
  };

  std::shared_ptr<scenegraph::Dataset> dataset_;
  std::string name_;
  std::optional<scenegraph::TopicId> topic_;
  std::optional<Inputs> shown_;
  scenegraph::Status shown_status_;
  std::shared_ptr<const SceneState> product_;
  scenegraph::Status status_{scenegraph::StatusLevel::Warn, "NoMessage", ""};
  scenegraph::LatestJob<SceneState> job_;
};

}  // namespace stillframe::nodes
