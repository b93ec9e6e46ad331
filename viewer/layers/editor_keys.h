#pragma once

#include <QObject>

class QTreeWidget;

namespace stillframe::viewer {

/// The keyboard in a tree whose rows have editors in their second column: Enter, F2 and Space on a row go into its
/// editor (Space ticks a check box there and then), Escape in the editor comes back to the row and forgets what was
/// half typed. The row whose editor has the focus, by key or by mouse, is the current one. Belongs to the tree. GUI
/// thread.
class EditorKeys : public QObject {
  Q_OBJECT

 public:
  explicit EditorKeys(QTreeWidget& tree);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  [[nodiscard]] bool enterRow(int key);
  void followFocus(const QWidget* focus);

  QTreeWidget& tree_;
};

/// What the keyboard types into first within an editor; nullptr where nothing takes the focus.
[[nodiscard]] QWidget* firstControl(QWidget& editor);

}  // namespace stillframe::viewer
