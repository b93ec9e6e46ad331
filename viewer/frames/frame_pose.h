#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <string>

#include "scenegraph/store/dataset.h"

class QLabel;
class QToolButton;

namespace stillframe::viewer {

class FramePicker;

/// The pose of any frame in any other at the tracker time, to read and to copy with all its digits; or why there is
/// none. GUI thread.
class FramePose : public QWidget {
  Q_OBJECT

 public:
  explicit FramePose(QWidget* parent = nullptr);

  void setDataset(std::shared_ptr<const scenegraph::Dataset> dataset);
  /// Shows the pose at `time`, of the frames there are now.
  void showAt(tf::TimePoint time);
  /// Pose of `source` in `target`; nullopt leaves the one there is.
  void choose(const std::optional<std::string>& target, const std::optional<std::string>& source);
  [[nodiscard]] QString text() const;
  /// What Copy puts into the clipboard; "" when there is no pose.
  [[nodiscard]] const QString& json() const noexcept { return json_; }
  [[nodiscard]] FramePicker& target() noexcept { return *target_; }
  [[nodiscard]] FramePicker& source() noexcept { return *source_; }

 private:
  std::shared_ptr<const scenegraph::Dataset> dataset_;
  tf::TimePoint time_;
  std::optional<std::string> target_name_;
  std::optional<std::string> source_name_;
  QString json_;
  FramePicker* source_ = nullptr;
  FramePicker* target_ = nullptr;
  QLabel* label_ = nullptr;
  QToolButton* copy_ = nullptr;
};

}  // namespace stillframe::viewer
