#pragma once

#include <QProgressBar>

namespace stillframe::viewer {

/// Sets a progress bar's value; it is shown when the window paints next. QProgressBar::setValue() by itself paints the
/// whole window at once, with whatever views of it wait to be drawn, within the event that reports progress.
inline void setLater(QProgressBar& bar, int value) {
  bar.setUpdatesEnabled(false);
  bar.setValue(value);
  bar.setUpdatesEnabled(true);  // which asks for an update
}

}  // namespace stillframe::viewer
