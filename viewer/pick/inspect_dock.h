#pragma once

#include <QDockWidget>

class QMainWindow;

namespace stillframe::viewer {

class InspectPanel;
class SceneWidget;

/// The InspectPanel of a window, at its right; it shows itself with the first thing that is picked. GUI thread.
class InspectDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit InspectDock(QMainWindow& window);

  /// Turns to this view whenever something is picked in it.
  void watch(SceneWidget& view);
  /// Tells of this view from now on.
  void setView(SceneWidget& view);
  [[nodiscard]] InspectPanel& panel() noexcept { return *panel_; }

 private:
  bool has_been_shown_ = false;  // the first time it takes its share of the room
  InspectPanel* panel_ = nullptr;
};

}  // namespace stillframe::viewer
