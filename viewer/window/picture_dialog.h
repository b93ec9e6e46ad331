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
class ViewPanel;

/// Asks how large a picture of a view is to be, and what of its background, legend and picks it has. GUI thread.
class PictureDialog : public QDialog {
  Q_OBJECT

 public:
  /// `shown` is what the view shows on the screen, which is offered first.
  explicit PictureDialog(const PictureRequest& shown, QWidget* parent = nullptr);

  [[nodiscard]] PictureRequest request() const;

 private:
  QSpinBox* width_ = nullptr;
  QSpinBox* height_ = nullptr;
  QCheckBox* transparent_ = nullptr;
  QCheckBox* legend_ = nullptr;
  QCheckBox* picks_ = nullptr;
};

/// Adds "Save picture of the view" and "... of the window" to `menu`: they ask, save through `saver`, and say in the
/// window's status bar what has become of it. `shown_view` gives the view that is meant.
void addPictureActions(QMenu& menu, QMainWindow& window, PictureSaver& saver, std::function<ViewPanel&()> shown_view);

}  // namespace stillframe::viewer
