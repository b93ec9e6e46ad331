#pragma once

#include <QWidget>
#include <optional>
#include <utility>
#include <vector>

#include "scenegraph/camera/picking.h"
#include "scenegraph/pick/scene_pick.h"

namespace stillframe::viewer {

/// What has been picked and measured in one view, drawn over it: a ring round the picked point, a line between two with
/// its length. Every point goes along with its source frame. Lets the mouse through; draws nothing in the 3D picture.
/// GUI thread.
class ViewPicks : public QWidget {
  Q_OBJECT

 public:
  using Pair = std::pair<scenegraph::PickResult, scenegraph::PickResult>;

  explicit ViewPicks(QWidget* parent);

  void select(std::optional<scenegraph::PickResult> picked);
  [[nodiscard]] const std::optional<scenegraph::PickResult>& selected() const noexcept { return selected_; }
  /// From what was picked last to `end`, which is selected then. Without a first point there is only the selection.
  void measureTo(scenegraph::PickResult end);
  [[nodiscard]] const std::vector<Pair>& measured() const noexcept { return measured_; }
  void removeMeasurement(std::size_t index);
  void clear();

  /// In the fixed frame, as its frames are now; nullopt when one of them has no place.
  [[nodiscard]] static std::optional<scenegraph::Measurement> lengthOf(const scenegraph::Scene& scene,
                                                                       const Pair& pair);
  /// "3.21 m  (dx 1.2, dy -0.5, dz 2.9)".
  [[nodiscard]] static QString text(const scenegraph::Measurement& measurement);
  /// Brings what is drawn to a picture of that view.
  void place(const scenegraph::Scene& scene, const scenegraph::CameraView& view);
  /// Lines on the screen, for tests.
  [[nodiscard]] const std::vector<QLineF>& lines() const noexcept { return lines_; }
  [[nodiscard]] const std::optional<QPointF>& ring() const noexcept { return ring_; }

 Q_SIGNALS:
  void changed();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void onChanged();

  std::optional<scenegraph::PickResult> selected_;
  std::vector<Pair> measured_;
  std::optional<QPointF> ring_;
  std::vector<QLineF> lines_;
  std::vector<QString> texts_;
};

}  // namespace stillframe::viewer
