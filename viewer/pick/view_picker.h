#pragma once

#include <QObject>
#include <QPointF>
#include <QTimer>
#include <deque>
#include <optional>

#include "scenegraph/camera/camera.h"
#include "viewer/widget/update_gate.h"

namespace stillframe::viewer {

class HoverLabel;
class SceneWidget;
class ViewPicks;

/// What the mouse picks in one view: says what is under the cursor, selects what is clicked, measures with Shift.
///
/// Frames are named at once. The thing under the cursor is looked for when the event loop comes to it, for the latest
/// place alone; where that has taken long (software OpenGL, millions of voxels), when the cursor rests. Shaders for it
/// are made an event each; clicks wait for them, and are answered one after the other, in the picture that was clicked.
/// GUI thread.
class ViewPicker : public QObject {
  Q_OBJECT

 public:
  explicit ViewPicker(SceneWidget& view);

  [[nodiscard]] ViewPicks& picks() noexcept { return *picks_; }
  [[nodiscard]] HoverLabel& label() noexcept { return *label_; }
  /// Whether a click waits for its answer: the view stands still as long, so that what was clicked is what is picked.
  [[nodiscard]] bool holdsView() const noexcept { return !clicks_.empty(); }
  /// Clicks that wait get no answer: their places are of a picture that is gone.
  void dropClicks();
  void press(QPointF position);
  void hover(QPointF position);
  /// Of the left button: a click where the mouse has not moved since press().
  void release(QPointF position, bool measures);
  /// By keys: what is in the middle of the view, and says it there.
  void pickMiddle(bool measures);
  void leave();
  /// Another dataset: nothing is picked.
  void clear();
  /// A frame is about to be shown, which was drawn from there.
  void showFrame(const scenegraph::CameraView& view);

 private:
  struct Click {
    QPointF position;
    bool measures = false;
    bool is_by_keys = false;  // in the middle: the answer is said there
  };
  void ask(const Click& click);
  void answer();
  void answerClick(const Click& click);
  void hoverThing();
  bool pickAt(QPointF position, bool measures);
  void onPicksChanged();
  void place();

  SceneWidget& view_;
  scenegraph::CameraView shown_;  // what the frame that is shown was drawn from
  ViewPicks* picks_ = nullptr;
  HoverLabel* label_ = nullptr;
  QString frame_;                  // hovered
  std::optional<QPointF> cursor_;  // over the view, no button down
  QPointF pressed_;
  std::deque<Click> clicks_;  // that wait for their answers, in order
  double last_ms_ = 0.0;      // that looking for the thing took
  QTimer rest_;
  UpdateGate gate_;
};

}  // namespace stillframe::viewer
