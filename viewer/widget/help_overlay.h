#pragma once

#include <QLabel>

namespace stillframe::viewer {

/// The keys and gestures of a view, in two columns over its middle. Lets the mouse through. GUI thread.
class HelpOverlay : public QLabel {
  Q_OBJECT

 public:
  explicit HelpOverlay(QWidget* parent);
  /// Shows or hides it, in the middle of the parent.
  void setShown(bool shown);
  [[nodiscard]] bool isShown() const { return !isHidden(); }
  /// To the middle of the parent again, after it was resized.
  void place();
};

}  // namespace stillframe::viewer
