#pragma once

#include <QWidget>

namespace stillframe::viewer {

/// Lets Tab go through the controls within `root` as they are laid out: by layouts, splitters, and in trees row by row
/// through the rows' editors, which Qt leaves in the order in which they were made. To be called again when controls
/// were added; costs microseconds a control. GUI thread.
void orderTabs(QWidget& root);

}  // namespace stillframe::viewer
