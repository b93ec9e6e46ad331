#pragma once

#include <QWidget>

#include "scenegraph/layout/window_layout.h"

namespace stillframe::viewer {

/// Where a window is and how large, without what is in it.
void takePlace(const QWidget& window, scenegraph::WindowLayout& layout);

/// Brings a window there, shown or not yet. A corner that no screen shows any more (another machine, a screen that is
/// gone) is left out: the window system finds it a place.
void bringToPlace(const scenegraph::WindowLayout& layout, QWidget& window);

}  // namespace stillframe::viewer
