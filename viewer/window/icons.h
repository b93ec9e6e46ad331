#pragma once

#include <QIcon>

namespace stillframe::viewer {

/// Signs that the system's icon theme may lack, drawn in the palette's text colour.
enum class TransportIcon {
  Play,
  Pause,
  StepBack,
  StepForward,
  Loop,
  Recenter,
  Target,
  SplitRight,
  SplitBelow,
  Detach,
  Grip,
  Close,
  Layers,
  Effects,
  Legend,
  More
};

[[nodiscard]] QIcon transportIcon(TransportIcon icon);

}  // namespace stillframe::viewer
