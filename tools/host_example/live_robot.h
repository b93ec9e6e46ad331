#pragma once

#include <QString>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "scenegraph/store/dataset.h"

namespace host_example {

/// A number over time, by name: what the plot draws.
struct Value {
  QString name;
  std::function<std::optional<double>(stillframe::tf::TimePoint)> at;
};

/// The host's data source: a robot that drives in a room and never ends, as a dataset that grows. GUI thread.
///
/// Its messages are functions of their time, so nothing of them is kept but 32 bytes each.
class LiveRobot {
 public:
  LiveRobot();

  [[nodiscard]] const std::shared_ptr<stillframe::scenegraph::Dataset>& dataset() const { return dataset_; }
  /// All messages up to `time`, and their transforms.
  void growTo(stillframe::tf::TimePoint time);
  /// The newest message.
  [[nodiscard]] stillframe::tf::TimePoint newest() const { return newest_; }
  /// Every number there is: the robot's own, and place and heading of each frame in each root.
  [[nodiscard]] std::vector<Value> values() const;

 private:
  std::shared_ptr<stillframe::scenegraph::Dataset> dataset_;
  stillframe::scenegraph::TopicId transforms_ = 0;
  stillframe::scenegraph::TopicId cloud_ = 0;
  stillframe::tf::TimePoint newest_;
};

}  // namespace host_example
