#pragma once

#include <QWidget>
#include <optional>
#include <vector>

#include "scenegraph/pick/place_picks.h"

namespace stillframe::viewer {

/// What has been picked and measured in one view, drawn over it: a ring round the picked point, a line between two with
/// its length. Every point goes along with its source frame. Lets the mouse through; draws nothing in the 3D picture.
/// GUI thread.
class ViewPicks : public QWidget {
  Q_OBJECT

 public:
  explicit ViewPicks(QWidget* parent);

  void select(std::optional<scenegraph::PickResult> picked);
  [[nodiscard]] const std::optional<scenegraph::PickResult>& selected() const noexcept { return marks_.selected; }
  /// From what was picked last to `end`, which is selected then. Without a first point there is only the selection.
  void measureTo(scenegraph::PickResult end);
  [[nodiscard]] const std::vector<scenegraph::PickMarks::Pair>& measured() const noexcept { return marks_.measured; }
  void removeMeasurement(std::size_t index);
  void clear();
  /// All of it, as a layout keeps it.
  [[nodiscard]] const scenegraph::PickMarks& marks() const noexcept { return marks_; }
  void restore(scenegraph::PickMarks marks);

  /// Brings what is drawn to a picture of that view.
  void place(const scenegraph::Scene& scene, const scenegraph::CameraView& view);
  /// What is on the screen, in its pixels.
  [[nodiscard]] const scenegraph::PlacedPicks& placed() const noexcept { return placed_; }

 Q_SIGNALS:
  void changed();
  /// By hand, just now: after changed().
  void picked();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  scenegraph::PickMarks marks_;
  scenegraph::PlacedPicks placed_;
};

}  // namespace stillframe::viewer
