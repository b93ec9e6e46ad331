#pragma once

#include <QWidget>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "scenegraph/store/dataset.h"

class QLabel;
class QLineEdit;
class QTimer;
class QTreeWidget;
class QTreeWidgetItem;

namespace stillframe::viewer {

class FramePose;
class ProblemList;

/// The frames panel: the TF tree (age of the sample in force, samples, rate, span of each frame; a box to show or hide
/// it), a filter for its rows, the recording's problems, and the pose of any frame in any other.
///
/// Frames are listed whatever the time and fill in while a file loads. GUI thread. Refreshes are put off and merged:
/// at most ten a second, none while nothing changes or the panel is hidden.
class FrameTree : public QWidget {
  Q_OBJECT

 public:
  using Names = std::set<std::string, std::less<>>;

  explicit FrameTree(QWidget* parent = nullptr);

  void setDataset(std::shared_ptr<const scenegraph::Dataset> dataset);
  void setTime(tf::TimePoint time);
  /// The frames that the view at hand does not draw.
  void setHiddenFrames(const Names& hidden);
  /// The dataset may have grown.
  void refreshLater();
  void refreshNow();

  [[nodiscard]] QTreeWidget& tree() noexcept { return *tree_; }
  [[nodiscard]] ProblemList& problems() noexcept { return *problems_; }
  [[nodiscard]] FramePose& pose() noexcept { return *pose_; }
  [[nodiscard]] QLineEdit& filter() noexcept { return *filter_; }
  /// Item of a frame; nullptr when it is not listed.
  [[nodiscard]] QTreeWidgetItem* item(const std::string& frame) const;

 Q_SIGNALS:
  /// The user clicked a frame.
  void framePicked(const QString& frame);
  /// The user double-clicked a frame, or pressed Return on it.
  void frameActivated(const QString& frame);
  /// The user wants just these frames hidden.
  void hiddenFramesEdited(const std::set<std::string, std::less<>>& hidden);
  void timeRequested(tf::TimePoint time);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* makeFilterRow();
  void makeTree(QWidget* parent);
  void rebuild();
  void showSamples();
  void showSample(std::size_t id, const tf::EdgeInfo& edge);
  void applyFilter();
  void onBox(QTreeWidgetItem* row);
  void setAllListed(bool visible);

  static constexpr std::size_t kMaxRows = 20'000;

  std::shared_ptr<const scenegraph::Dataset> dataset_;
  tf::TimePoint time_;
  std::vector<QTreeWidgetItem*> items_;  // index = FrameId
  std::vector<tf::FrameId> parents_;     // as shown
  std::vector<bool> matches_;            // the filter
  Names hidden_;
  bool is_filling_ = false;   // boxes are set by us
  bool has_toggled_ = false;  // the click under way was upon a box
  QLineEdit* filter_ = nullptr;
  QLabel* refusal_ = nullptr;  // of the filter
  QTreeWidget* tree_ = nullptr;
  ProblemList* problems_ = nullptr;
  FramePose* pose_ = nullptr;
  QLabel* more_ = nullptr;
  QTimer* timer_ = nullptr;
};

/// "3.2 ms", "12.5 s": a duration for people.
[[nodiscard]] QString durationText(double seconds);

}  // namespace stillframe::viewer
