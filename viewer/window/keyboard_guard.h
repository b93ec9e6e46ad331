#pragma once

#include <QObject>

namespace stillframe::viewer {

/// Leaves to the widget that has the focus the keys it needs: Space presses a focused button or checks a row, and the
/// arrows move in a tree or a list, although the window has them as shortcuts. An event filter for the application; GUI
/// thread.
class KeyboardGuard : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;
  bool eventFilter(QObject* watched, QEvent* event) override;
};

/// Gives every button within `root` the keyboard's focus, and every control a name that a screen reader can say: its
/// tool tip's first line or its placeholder, where it has no text. Tab goes through them as they are laid out.
void makeReachable(QWidget& root);

}  // namespace stillframe::viewer
