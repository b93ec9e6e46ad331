#pragma once

#include <QLabel>
#include <vector>

#include "nodes/legend/legend_picture.h"

namespace stillframe::viewer {

/// The legends of a view's colours in its lower right corner; absent where nothing is coloured by value. Lets the mouse
/// through. GUI thread.
class LegendOverlay : public QLabel {
  Q_OBJECT

 public:
  /// Lies over `view`, and keeps to its corner.
  explicit LegendOverlay(QWidget& view);

  /// Shows what `scene` colours now; draws only when that is new. nullptr: nothing.
  void refresh(const scenegraph::Scene* scene);
  /// On at first.
  void setEnabledByUser(bool enabled);
  [[nodiscard]] bool isEnabledByUser() const noexcept { return is_enabled_; }
  [[nodiscard]] const std::vector<nodes::LegendEntry>& entries() const noexcept { return entries_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void draw();

  std::vector<nodes::LegendEntry> entries_;
  bool is_enabled_ = true;
};

}  // namespace stillframe::viewer
