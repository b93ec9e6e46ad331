#include "viewer/layers/editor_keys.h"

#include <QApplication>
#include <QCheckBox>
#include <QKeyEvent>
#include <QSlider>
#include <QTreeWidget>
#include <QTreeWidgetItemIterator>
#include <algorithm>

namespace stillframe::viewer {

QWidget* firstControl(QWidget& editor) {
  const QList<QWidget*> parts = editor.findChildren<QWidget*>();
  const auto takes_focus = [&](const QWidget* part) {
    return (part->focusPolicy() & Qt::TabFocus) != 0 && part->focusProxy() == nullptr && part->isEnabledTo(&editor);
  };
  // Of a slider with its number, the number: it takes any value.
  for (const bool may_slide : {false, true}) {
    const auto found = std::ranges::find_if(parts, [&](const QWidget* part) {
      return takes_focus(part) && (may_slide || qobject_cast<const QSlider*>(part) == nullptr);
    });
    if (found != parts.end()) {
      return *found;
    }
  }
  return nullptr;
}

EditorKeys::EditorKeys(QTreeWidget& tree) : QObject(&tree), tree_(tree) {
  tree.installEventFilter(this);
  connect(qApp, &QApplication::focusChanged, this, [this](const QWidget* /*old*/, const QWidget* now) {
    if (now != nullptr && tree_.viewport()->isAncestorOf(now)) {
      followFocus(now);
    }
  });
}

/// What is done to the current row, by a button or a key, means the one whose value was typed last.
void EditorKeys::followFocus(const QWidget* focus) {
  for (QTreeWidgetItemIterator row(&tree_); *row != nullptr; ++row) {
    const QWidget* const editor = tree_.itemWidget(*row, 1);
    if (editor != nullptr && (editor == focus || editor->isAncestorOf(focus))) {
      tree_.setCurrentItem(*row);
      return;
    }
  }
}

bool EditorKeys::enterRow(int key) {
  QTreeWidgetItem* const row = tree_.currentItem();
  QWidget* const editor = row == nullptr ? nullptr : tree_.itemWidget(row, 1);
  QWidget* const control = editor == nullptr ? nullptr : firstControl(*editor);
  if (control == nullptr || (key == Qt::Key_Space && row->flags().testFlag(Qt::ItemIsUserCheckable))) {
    return false;
  }
  if (auto* const box = qobject_cast<QCheckBox*>(control); box != nullptr && key == Qt::Key_Space) {
    box->toggle();
    return true;
  }
  control->setFocus(Qt::TabFocusReason);  // texts are selected, to be written over
  return true;
}

bool EditorKeys::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::KeyPress && watched == &tree_) {
    const auto* const key = static_cast<QKeyEvent*>(event);
    const bool is_plain = (key->modifiers() & ~Qt::KeypadModifier) == Qt::NoModifier;
    const bool enters = key->key() == Qt::Key_Return || key->key() == Qt::Key_Enter || key->key() == Qt::Key_F2 ||
                        key->key() == Qt::Key_Space;
    if (is_plain && enters && enterRow(key->key())) {
      return true;
    }
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace stillframe::viewer
