#include "viewer/window/view_window.h"

#include <QCloseEvent>
#include <QVBoxLayout>

#include "viewer/window/view_area.h"

namespace stillframe::viewer {

ViewWindow::ViewWindow(QWidget* parent) : QWidget(parent, Qt::Window), area_(new ViewArea(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(area_);
}

void ViewWindow::closeEvent(QCloseEvent* event) {
  event->accept();
  Q_EMIT closed();
}

}  // namespace stillframe::viewer
