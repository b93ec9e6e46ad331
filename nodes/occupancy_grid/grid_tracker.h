#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "nodes/occupancy_grid/grid_history.h"
#include "scenegraph/latest_job.h"
#include "scenegraph/layer.h"
#include "scenegraph/status.h"
#include "scenegraph/store/dataset.h"

namespace stillframe::nodes {

/// A state of a grid with what its base says.
struct GridSnapshot {
  GridHeader header;
  std::shared_ptr<const GridState> state;
  scenegraph::Entry base;
};

/// The topic whose grids the updates on `updates_topic` change: "X" for "X_updates" (and so ".../costmap" for
/// ".../costmap_updates"); "" when the name says none.
[[nodiscard]] std::string baseTopicOf(std::string_view updates_topic);
/// Whether `topic` carries updates for which there are no grids.
[[nodiscard]] bool isOrphan(const scenegraph::ObjectStore& store, std::string_view topic);

/// Brings a grid with its updates to a tick, off the GUI thread: the newest base at or before it, then every update
/// after the base's log time up to it, in order.
///
/// As SampleLoader does for types whose messages stand alone: latest wins, the state before stays meanwhile and
/// status() says so. The history lies in the dataset's cache, shared by all views. GUI thread only.
class GridTracker {
 public:
  GridTracker(const scenegraph::LayerContext& context, std::string topic);

  /// Returns whether product() or status() changed.
  bool update(tf::TimePoint time);
  /// What to draw; nullptr when there is nothing.
  [[nodiscard]] const std::shared_ptr<const GridSnapshot>& product() const noexcept { return product_; }
  /// Ok; NoTopic, NoMessage, UpdateBeforeBase, UpdateWithoutBase; Decoding; or why the base cannot be drawn.
  [[nodiscard]] const scenegraph::Status& status() const noexcept { return status_; }
  [[nodiscard]] bool isPending() const { return job_.isPending(); }

 private:
  void findTopics();
  [[nodiscard]] scenegraph::Status nothing(tf::TimePoint time) const;
  bool show(std::shared_ptr<const GridSnapshot> product, scenegraph::Status status);

  std::shared_ptr<scenegraph::Dataset> dataset_;
  std::string name_;
  std::size_t topics_looked_at_ = 0;
  std::optional<scenegraph::TopicId> base_topic_;
  std::optional<scenegraph::TopicId> updates_topic_;
  std::optional<scenegraph::CacheKey> shown_key_;
  scenegraph::Status shown_status_;
  std::shared_ptr<const GridSnapshot> product_;
  scenegraph::Status status_{scenegraph::StatusLevel::Warn, "NoMessage", ""};
  scenegraph::LatestJob<GridSnapshot> job_;
};

}  // namespace stillframe::nodes
