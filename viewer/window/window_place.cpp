#include "viewer/window/window_place.h"

#include <QGuiApplication>
#include <QScreen>
#include <algorithm>

namespace stillframe::viewer {
namespace {

// What a hand needs of a window's upper edge to pull it to another place.
constexpr int kGripWidth = 80;
constexpr int kGripHeight = 20;

bool isWithinReach(const QRect& upper_edge) {
  return std::ranges::any_of(QGuiApplication::screens(), [&](const QScreen* screen) {
    const QRect seen = screen->availableGeometry() & upper_edge;
    return seen.width() >= std::min(kGripWidth, upper_edge.width()) && seen.height() >= kGripHeight;
  });
}

}  // namespace

void takePlace(const QWidget& window, scenegraph::WindowLayout& layout) {
  layout.is_maximized = window.isMaximized();
  const QRect normal = window.normalGeometry();
  const bool has_normal = layout.is_maximized && normal.isValid();
  layout.width = has_normal ? normal.width() : window.width();
  layout.height = has_normal ? normal.height() : window.height();
  if (window.isVisible()) {
    const QPoint corner = has_normal ? normal.topLeft() : window.pos();
    layout.corner = {corner.x(), corner.y()};
  }
}

void bringToPlace(const scenegraph::WindowLayout& layout, QWidget& window) {
  window.setWindowState(window.windowState() & ~Qt::WindowMaximized);
  window.resize(layout.width, layout.height);
  if (layout.corner) {
    const QPoint corner(layout.corner->first, layout.corner->second);
    if (isWithinReach(QRect(corner, QSize(layout.width, kGripHeight)))) {
      window.move(corner);
    }
  }
  if (layout.is_maximized) {
    window.setWindowState(window.windowState() | Qt::WindowMaximized);
  }
}

}  // namespace stillframe::viewer
