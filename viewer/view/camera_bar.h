#pragma once

#include <QToolBar>

class QAction;
class QComboBox;
class QMenu;

namespace stillframe::viewer {

class FramePicker;
class NarrowBar;
class SceneWidget;

/// Camera model, display frame, follow mode, recenter and saved views of one view; what does not fit is in the menu of
/// the tool bar's extension, lists as menus of their entries. Every control has a key in the view, too. GUI thread.
class CameraBar : public QToolBar {
  Q_OBJECT

 public:
  explicit CameraBar(SceneWidget& view, QWidget* parent = nullptr);
  /// What that one spares is in the extension's menu too. It outlives this.
  void setBar(const NarrowBar& bar) { bar_ = &bar; }

  /// The frames of the recording may be more; cheap when nothing is new.
  void refresh();
  [[nodiscard]] QComboBox& kinds() noexcept { return *kinds_; }
  [[nodiscard]] QComboBox& follows() noexcept { return *follows_; }
  [[nodiscard]] FramePicker& displayFrame() noexcept { return *display_frame_; }
  [[nodiscard]] QMenu& views() noexcept { return *views_; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fillMore();
  void showCamera();
  void fillViews();
  void askForName();

  SceneWidget& view_;
  const NarrowBar* bar_ = nullptr;
  QComboBox* kinds_ = nullptr;
  QComboBox* follows_ = nullptr;
  FramePicker* display_frame_ = nullptr;
  QAction* recenter_ = nullptr;
  QMenu* views_ = nullptr;
  QMenu* more_ = nullptr;  ///< the extension's, filled with what is cut off when it opens
};

}  // namespace stillframe::viewer
