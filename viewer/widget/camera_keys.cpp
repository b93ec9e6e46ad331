#include "viewer/widget/camera_keys.h"

#include <QCoreApplication>
#include <QKeyEvent>
#include <algorithm>
#include <array>

namespace stillframe::viewer {
namespace {

constexpr double kFast = 4.0;
constexpr Qt::KeyboardModifiers kNone = Qt::NoModifier;
constexpr Qt::KeyboardModifiers kShift = Qt::ShiftModifier;
constexpr Qt::KeyboardModifiers kCtrl = Qt::ControlModifier;

struct Binding {
  int key = 0;
  Qt::KeyboardModifiers modifiers;
  CameraCommand command = CameraCommand::Home;
  const char* keys = "";  ///< as the help names them; "" goes with the line above
  const char* what = "";
};

using enum CameraCommand;
const std::array<Binding, 39> kBindings = {{
    {Qt::Key_Home, kNone, Home, "Home", "default view"},
    {Qt::Key_F, kNone, Frame, "F", "frame the selection, or everything"},
    {Qt::Key_F, kShift, FrameAll, "Shift+F", "frame everything"},
    {Qt::Key_R, kNone, Recenter, "R", "bring the followed frame to the middle, upright"},
    {Qt::Key_T, kNone, NextFollow, "T", "follow: off, position, heading, pose"},
    {Qt::Key_1, kNone, Orbit, "1", "orbit"},
    {Qt::Key_2, kNone, XyOrbit, "2", "orbit on the ground"},
    {Qt::Key_3, kNone, TopDownOrtho, "3", "from above, without perspective"},
    {Qt::Key_4, kNone, Fly, "4", "fly"},
    {Qt::Key_X, kNone, FromX, "X  Y  Z", "look from +x, +y, +z; with Shift from the other side"},
    {Qt::Key_Y, kNone, FromY, "", ""},
    {Qt::Key_Z, kNone, FromZ, "", ""},
    {Qt::Key_X, kShift, FromMinusX, "", ""},
    {Qt::Key_Y, kShift, FromMinusY, "", ""},
    {Qt::Key_Z, kShift, FromMinusZ, "", ""},
    {Qt::Key_Left, kShift, TurnLeft, "Shift+arrows", "turn"},
    {Qt::Key_Right, kShift, TurnRight, "", ""},
    {Qt::Key_Up, kShift, TurnUp, "", ""},
    {Qt::Key_Down, kShift, TurnDown, "", ""},
    {Qt::Key_Left, kCtrl, PanLeft, "Ctrl+arrows", "pan"},
    {Qt::Key_Right, kCtrl, PanRight, "", ""},
    {Qt::Key_Up, kCtrl, PanUp, "", ""},
    {Qt::Key_Down, kCtrl, PanDown, "", ""},
    {Qt::Key_PageUp, kNone, ZoomIn, "+  -, PgUp  PgDown", "zoom"},
    {Qt::Key_PageDown, kNone, ZoomOut, "", ""},
    {Qt::Key_Plus, kNone, ZoomIn, "", ""},
    {Qt::Key_Plus, kShift, ZoomIn, "", ""},
    {Qt::Key_Equal, kNone, ZoomIn, "", ""},
    {Qt::Key_Minus, kNone, ZoomOut, "", ""},
    {Qt::Key_BracketLeft, kNone, PaceDown, "[  ], Shift+wheel", "slower, faster (fly)"},
    {Qt::Key_BracketRight, kNone, PaceUp, "", ""},
    {Qt::Key_B, kNone, SaveView, "B", "save this view"},
    {Qt::Key_P, kNone, PickMiddle, "P, Shift+P", "pick what is in the middle; measure from it to here"},
    {Qt::Key_P, kShift, MeasureMiddle, "", ""},
    {Qt::Key_Delete, kNone, ClearPicks, "Delete", "nothing picked, nothing measured"},
    {Qt::Key_Question, kNone, Help, "?, F1", "this help; Esc closes it"},
    {Qt::Key_Question, kShift, Help, "", ""},
    {Qt::Key_F1, kNone, Help, "", ""},
    {Qt::Key_Escape, kNone, CloseHelp, "", ""},
}};

constexpr std::array<int, 6> kWalkingKeys = {Qt::Key_W, Qt::Key_A, Qt::Key_S, Qt::Key_D, Qt::Key_Q, Qt::Key_E};

/// Without the flag that says where on the keyboard a key is.
Qt::KeyboardModifiers modifiersOf(const QKeyEvent& event) { return event.modifiers() & ~Qt::KeypadModifier; }

QString text(const char* english) { return QCoreApplication::translate("CameraKeys", english); }

}  // namespace

std::optional<CameraCommand> CameraKeys::command(const QKeyEvent& event) {
  const auto found = std::ranges::find_if(kBindings, [&](const Binding& binding) {
    return binding.key == event.key() && binding.modifiers == modifiersOf(event);
  });
  return found == kBindings.end() ? std::nullopt : std::optional(found->command);
}

std::optional<int> CameraKeys::savedView(const QKeyEvent& event) {
  return modifiersOf(event) == kCtrl && event.key() >= Qt::Key_1 && event.key() <= Qt::Key_9
             ? std::optional(event.key() - Qt::Key_0)
             : std::nullopt;
}

std::vector<KeyHelp> CameraKeys::help() {
  std::vector<KeyHelp> lines = {
      {text("left drag"), text("turn round what is looked at; fly: look about")},
      {text("middle drag, Shift+left drag"), text("pan")},
      {text("wheel, right drag"), text("zoom; with Ctrl: to the cursor")},
      {text("click, Shift+click"), text("pick what is there; measure from it to here")},
      {text("click a frame in the list"), text("look at it")},
      {text("W A S D, Q E"), text("walk; down and up. Shift: faster")},
  };
  for (const Binding& binding : kBindings) {
    if (*binding.what != '\0') {
      lines.push_back({text(binding.keys), text(binding.what)});
    }
  }
  lines.push_back({text("Ctrl+1 .. Ctrl+9"), text("go to a saved view")});
  lines.push_back({text("Space, Left, Right"), text("play, step in time")});
  return lines;
}

bool CameraKeys::press(const QKeyEvent& event) {
  const Qt::KeyboardModifiers modifiers = modifiersOf(event);
  if (std::ranges::find(kWalkingKeys, event.key()) == kWalkingKeys.end() ||
      (modifiers != kNone && modifiers != kShift)) {
    return false;
  }
  held_.insert(event.key());
  is_fast_ = modifiers == kShift;
  return true;
}

bool CameraKeys::release(const QKeyEvent& event) { return !event.isAutoRepeat() && held_.remove(event.key()); }

glm::dvec3 CameraKeys::direction() const {
  const auto between = [this](int forth, int back) {
    return (held_.contains(forth) ? 1.0 : 0.0) - (held_.contains(back) ? 1.0 : 0.0);
  };
  const glm::dvec3 direction(between(Qt::Key_D, Qt::Key_A), between(Qt::Key_E, Qt::Key_Q),
                             between(Qt::Key_W, Qt::Key_S));
  return is_fast_ ? kFast * direction : direction;
}

}  // namespace stillframe::viewer
