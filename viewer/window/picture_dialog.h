#pragma once

#include <QDialog>
#include <functional>

#include "viewer/widget/picture_request.h"

class QCheckBox;
class QMainWindow;
class QMenu;
class QSpinBox;

namespace stillframe::viewer {

class PictureSaver;
class SceneWidget;

/// Asks how large a picture of a view is to be, and whether the background is to be left out. GUI thread.
class PictureDialog : public QDialog {
  Q_OBJECT

 public:
  /// `shown_px` is the size of the view on the screen, which is offered first.
  explicit PictureDialog(QSize shown_px, QWidget* parent = nullptr);

  [[nodiscard]] PictureRequest request() const;

 private:
  QSpinBox* width_ = nullptr;
  QSpinBox* height_ = nullptr;
  QCheckBox* transparent_ = nullptr;
};

/// Adds "Save picture of the view" and "... of the window" to `menu`: they ask, save through `saver`, and say in the
/// window's status bar what has become of it. `shown_view` gives the view that is meant.
void addPictureActions(QMenu& menu, QMainWindow& window, PictureSaver& saver, std::function<SceneWidget&()> shown_view);

}  // namespace stillframe::viewer
