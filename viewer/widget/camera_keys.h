#pragma once

#include <QSet>
#include <QString>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

class QKeyEvent;

namespace stillframe::viewer {

/// What a key does in a view.
enum class CameraCommand : std::uint8_t {
  Home,      ///< the default view
  Frame,     ///< the selection, or everything
  FrameAll,  ///< everything
  Recenter,  ///< the followed frame to the middle, upright
  Orbit,     ///< the models, in the order of CameraKind
  XyOrbit,
  TopDownOrtho,
  Fly,
  NextFollow,  ///< off, position, heading, pose
  FromX,       ///< eye on that side of what is looked at
  FromY,
  FromZ,
  FromMinusX,
  FromMinusY,
  FromMinusZ,
  TurnLeft,
  TurnRight,
  TurnUp,
  TurnDown,
  PanLeft,
  PanRight,
  PanUp,
  PanDown,
  ZoomIn,
  ZoomOut,
  PaceUp,  ///< of a flying camera
  PaceDown,
  SaveView,
  PickMiddle,
  MeasureMiddle,
  ClearPicks,
  Help,
  CloseHelp,
};

/// One line of the help: keys or gestures, and what they do.
struct KeyHelp {
  QString keys;
  QString what;
};

/// Keys of a view: commands, and the keys W A S D Q E that carry the camera while they are held. No window.
class CameraKeys {
 public:
  /// The command of a key press, if it is one.
  [[nodiscard]] static std::optional<CameraCommand> command(const QKeyEvent& event);
  /// Number 1..9 of the saved view that Ctrl and a digit ask for.
  [[nodiscard]] static std::optional<int> savedView(const QKeyEvent& event);
  /// Everything that mouse and keys do, for the help; made from what command() reads.
  [[nodiscard]] static std::vector<KeyHelp> help();

  /// Takes a walking key; false for any other. Auto-repeat changes nothing.
  bool press(const QKeyEvent& event);
  bool release(const QKeyEvent& event);
  void releaseAll() { held_.clear(); }
  [[nodiscard]] bool isWalking() const { return !held_.isEmpty(); }
  /// Right, up and forward, -1..1; four times with Shift.
  [[nodiscard]] glm::dvec3 direction() const;

 private:
  QSet<int> held_;
  bool is_fast_ = false;
};

}  // namespace stillframe::viewer
