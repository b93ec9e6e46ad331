#include "viewer/window/keyboard_guard.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <QSlider>

#include "viewer/widget/tab_order.h"

namespace stillframe::viewer {
namespace {

bool isUsedBy(const QObject& widget, const QKeyEvent& event) {
  if (event.modifiers() & ~(Qt::KeypadModifier | Qt::ShiftModifier)) {
    return false;
  }
  const bool is_space = event.key() == Qt::Key_Space;
  const bool is_arrow = event.key() == Qt::Key_Left || event.key() == Qt::Key_Right;
  if (qobject_cast<const QAbstractButton*>(&widget) != nullptr) {
    return is_space;
  }
  const bool has_rows = qobject_cast<const QAbstractItemView*>(&widget) != nullptr ||
                        qobject_cast<const QComboBox*>(&widget) != nullptr ||
                        qobject_cast<const QAbstractSpinBox*>(&widget) != nullptr;
  return has_rows && (is_space || is_arrow);
}

}  // namespace

bool KeyboardGuard::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && isUsedBy(*watched, *static_cast<QKeyEvent*>(event))) {
    event->accept();
    return true;
  }
  return QObject::eventFilter(watched, event);
}

void makeReachable(QWidget& root) {
  for (QWidget* const widget : root.findChildren<QWidget*>()) {
    auto* const button = qobject_cast<QAbstractButton*>(widget);
    if (button != nullptr && button->focusPolicy() == Qt::NoFocus) {
      button->setFocusPolicy(Qt::TabFocus);
    }
    if (const auto* const edit = qobject_cast<QLineEdit*>(widget);
        edit != nullptr && edit->accessibleName().isEmpty() && edit->toolTip().isEmpty()) {
      widget->setAccessibleName(edit->placeholderText());
    }
    const bool says_itself = button != nullptr && !button->text().isEmpty();
    if (widget->accessibleName().isEmpty() && !says_itself && !widget->toolTip().isEmpty()) {
      widget->setAccessibleName(widget->toolTip().section(QLatin1Char('\n'), 0, 0));
    }
  }
  orderTabs(root);
}

}  // namespace stillframe::viewer
