#pragma once

#include <QElapsedTimer>
#include <QTreeWidget>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "scenegraph/store/dataset.h"
#include "viewer/widget/update_gate.h"

namespace stillframe::viewer {

/// The problems of a recording: those of reading it, and gaps, jumps and stale ends of its transforms, which are looked
/// for on a worker thread when transforms are new, every two seconds at most. A problem with a time can be clicked to
/// go there. GUI thread.
class ProblemList : public QTreeWidget {
  Q_OBJECT

 public:
  explicit ProblemList(QWidget* parent = nullptr);

  void setDataset(std::shared_ptr<const scenegraph::Dataset> dataset);
  /// The dataset may have grown.
  void refresh();
  /// Transforms of a recording that is being loaded seem to end early: they are looked through when all are there.
  void setLoading(bool is_loading);
  /// Whether the transforms there are now have been looked through.
  [[nodiscard]] bool isChecked() const;

 Q_SIGNALS:
  void timeRequested(tf::TimePoint time);
  void checked();

 private:
  struct Check;
  void startCheck();
  void showProblems();
  void onRow(QTreeWidgetItem* row);

  std::shared_ptr<const scenegraph::Dataset> dataset_;
  std::shared_ptr<Check> check_;  // under way or done, shared with the worker
  std::optional<std::uint64_t> checked_revision_;
  std::vector<scenegraph::Problem> of_edges_;
  std::vector<scenegraph::Problem> shown_;
  QElapsedTimer since_check_;
  bool is_loading_ = false;
  UpdateGate gate_;
};

}  // namespace stillframe::viewer
