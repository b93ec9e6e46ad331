#include "viewer/view/view_grip.h"

#include <QApplication>
#include <QMouseEvent>

#include "viewer/window/icons.h"

namespace stillframe::viewer {
namespace {

constexpr int kSize = 16;

}  // namespace

ViewGrip::ViewGrip(QWidget* parent) : QLabel(parent) {
  setObjectName(QStringLiteral("grip"));
  setPixmap(transportIcon(TransportIcon::Grip).pixmap(kSize, kSize));
  setCursor(Qt::OpenHandCursor);
  setToolTip(tr("Drag this view to a side of another one, or out of the window"));
}

void ViewGrip::mousePressEvent(QMouseEvent* event) { pressed_at_ = event->pos(); }

void ViewGrip::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons().testFlag(Qt::LeftButton) &&
      (event->pos() - pressed_at_).manhattanLength() >= QApplication::startDragDistance()) {
    Q_EMIT dragged();
  }
}

}  // namespace stillframe::viewer
