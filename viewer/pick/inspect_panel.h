#pragma once

#include <QPointer>
#include <QWidget>
#include <string>

class QLabel;
class QTreeWidget;
class QToolButton;

namespace stillframe::viewer {

class SceneWidget;

/// All that is known of what was picked in one view, to read and to copy with all its digits, and the distances
/// measured there. Positions and lengths are those of the present time. GUI thread.
class InspectPanel : public QWidget {
  Q_OBJECT

 public:
  explicit InspectPanel(QWidget* parent = nullptr);

  /// The view to tell of from now on; nullptr: none.
  void setView(SceneWidget* view);
  /// What Copy puts into the clipboard, of the lines chosen in either table, or of all: a name, a tab and a text a
  /// line; a distance with its components and both its ends, with all their digits.
  [[nodiscard]] QString copyText() const;
  [[nodiscard]] QTreeWidget& rows() noexcept { return *rows_; }
  [[nodiscard]] QTreeWidget& measurements() noexcept { return *measurements_; }

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void refresh();
  void onCamera();
  void refreshMeasurements();
  void copy();
  void removeMeasurements();

  QPointer<SceneWidget> view_;
  std::string display_frame_;  // whose coordinates are shown
  QLabel* hint_ = nullptr;
  QTreeWidget* rows_ = nullptr;
  QTreeWidget* measurements_ = nullptr;
  QToolButton* copy_ = nullptr;
  QToolButton* remove_ = nullptr;
};

}  // namespace stillframe::viewer
