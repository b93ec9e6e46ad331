#pragma once

#include <QLabel>
#include <QStringList>

namespace stillframe::viewer {

/// What is under the cursor, beside it: names of frames, one a line, and the thing that is drawn there. Lets the mouse
/// through. A window of its own, as tool tips are: over an OpenGL widget a child that moves would have it draw a frame.
/// GUI thread.
class HoverLabel : public QLabel {
  Q_OBJECT

 public:
  explicit HoverLabel(QWidget* parent);

  void setFrames(const QStringList& frames) { frames_ = frames; }
  /// One line; "" when nothing is known to be there.
  void setThing(const QString& thing) { thing_ = thing; }
  [[nodiscard]] const QString& thing() const noexcept { return thing_; }
  /// Shows it beside the cursor, on the side where there is room, or hides it when there is nothing to say.
  void showAt(QPointF cursor);
  /// Nothing to say any more.
  void clearAll();

 protected:
  /// Goes with its parent.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QStringList frames_;
  QString thing_;
};

}  // namespace stillframe::viewer
