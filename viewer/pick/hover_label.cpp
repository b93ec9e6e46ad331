#include "viewer/pick/hover_label.h"

#include <QEvent>
#include <algorithm>

namespace stillframe::viewer {
namespace {

constexpr int kOffset = 14;  // device-independent pixels from the cursor

}  // namespace

HoverLabel::HoverLabel(QWidget* parent)
    : QLabel(parent,
             Qt::ToolTip | Qt::FramelessWindowHint | Qt::WindowTransparentForInput | Qt::WindowDoesNotAcceptFocus) {
  setObjectName(QStringLiteral("hover"));
  setAttribute(Qt::WA_ShowWithoutActivating);
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setStyleSheet(QStringLiteral("color: white; background: #14161a; padding: 2px 5px;"));
  parent->installEventFilter(this);
  setTextFormat(Qt::PlainText);
  hide();
}

void HoverLabel::showAt(QPointF cursor) {
  QStringList lines = frames_;
  if (!thing_.isEmpty()) {
    lines << thing_;
  }
  if (lines.isEmpty()) {
    hide();
    return;
  }
  setText(lines.join(QLatin1Char('\n')));
  adjustSize();
  const int right = qRound(cursor.x()) + kOffset;
  const int left = qRound(cursor.x()) - kOffset - width();
  const int below = qRound(cursor.y()) + kOffset;
  const QPoint place(right + width() <= parentWidget()->width() ? right : std::max(0, left),
                     std::min(below, std::max(0, parentWidget()->height() - height())));
  move(parentWidget()->mapToGlobal(place));
  show();
}

bool HoverLabel::eventFilter(QObject* watched, QEvent* event) {
  // A key moves the camera, opens the help, or picks anew.
  if (event->type() == QEvent::Hide || event->type() == QEvent::WindowDeactivate || event->type() == QEvent::FocusOut ||
      event->type() == QEvent::KeyPress) {
    hide();
  }
  return QLabel::eventFilter(watched, event);
}

void HoverLabel::clearAll() {
  frames_.clear();
  thing_.clear();
  hide();
}

}  // namespace stillframe::viewer
