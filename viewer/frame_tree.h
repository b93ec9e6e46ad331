#pragma once

#include <QWidget>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "scenegraph/store/dataset.h"

class QLabel;
class QTimer;
class QTreeWidget;
class QTreeWidgetItem;

namespace stillframe::viewer {

/// The TF tree (frame, age of the sample in force, samples, rate) with the recording's problems below it.
///
/// Frames are listed whatever the time and fill in while a file loads. GUI thread. Refreshes are put off and merged:
/// at most ten a second, none while nothing changes or the panel is hidden.
class FrameTree : public QWidget {
  Q_OBJECT

 public:
  explicit FrameTree(QWidget* parent = nullptr);

  void setDataset(std::shared_ptr<const scenegraph::Dataset> dataset);
  void setTime(tf::TimePoint time);
  /// The dataset may have grown.
  void refreshLater();
  void refreshNow();

  [[nodiscard]] QTreeWidget& tree() noexcept { return *tree_; }
  [[nodiscard]] QTreeWidget& problems() noexcept { return *problems_; }
  /// Item of a frame; nullptr when it is not listed.
  [[nodiscard]] QTreeWidgetItem* item(const std::string& frame) const;

 Q_SIGNALS:
  /// The user clicked a frame.
  void framePicked(const QString& frame);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void rebuild();
  void showSamples();
  void showProblems();

  static constexpr std::size_t kMaxRows = 20'000;

  std::shared_ptr<const scenegraph::Dataset> dataset_;
  tf::TimePoint time_;
  std::vector<QTreeWidgetItem*> items_;  // index = FrameId
  std::vector<tf::FrameId> parents_;     // as shown
  QTreeWidget* tree_ = nullptr;
  QTreeWidget* problems_ = nullptr;
  QLabel* more_ = nullptr;
  QTimer* timer_ = nullptr;
};

/// "3.2 ms", "12.5 s": a duration for people.
[[nodiscard]] QString durationText(double seconds);

}  // namespace stillframe::viewer
