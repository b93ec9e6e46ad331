#pragma once

#include <QSize>
#include <QSizeF>
#include <QWidget>

namespace stillframe::viewer {

/// In device pixels, as framebuffers of widgets are made. GUI thread.
[[nodiscard]] inline QSize sizePxOf(const QWidget& widget) {
  return (QSizeF(widget.size()) * widget.devicePixelRatioF()).toSize();
}

}  // namespace stillframe::viewer
