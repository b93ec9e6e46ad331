#include "viewer/pick/hover_label.h"

#include <algorithm>

namespace stillframe::viewer {
namespace {

constexpr int kOffset = 14;  // device-independent pixels from the cursor

}  // namespace

HoverLabel::HoverLabel(QWidget* parent) : QLabel(parent) {
  setObjectName(QStringLiteral("hover"));
  setAttribute(Qt::WA_TransparentForMouseEvents);
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
  move(right + width() <= parentWidget()->width() ? right : std::max(0, left),
       std::min(below, std::max(0, parentWidget()->height() - height())));
  show();
}

void HoverLabel::clearAll() {
  frames_.clear();
  thing_.clear();
  hide();
}

}  // namespace stillframe::viewer
