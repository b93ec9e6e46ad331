// Events of SceneWidget: gestures, keys, hover, being shown and resized.
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QScopedValueRollback>
#include <QWheelEvent>

#include "viewer/pick/hover_label.h"
#include "viewer/pick/view_picker.h"
#include "viewer/pick/view_picks.h"
#include "viewer/widget/help_overlay.h"
#include "viewer/widget/scene_widget.h"
#include "viewer/widget/size_px.h"

namespace stillframe::viewer {
namespace {

constexpr double kWheelNotch = 120.0;  // eighths of a degree, as QWheelEvent counts

}  // namespace

/// The framebuffer is new.
void SceneWidget::startBlank() {
  picker_->dropClicks();
  steps_.at = FrameSteps::At::Rest;
  steps_.is_blank = true;
  update();
}

/// On a screen with other pixels there is a new framebuffer, without a resize.
bool SceneWidget::event(QEvent* event) {
  const bool is_sharper =
      event->type() == QEvent::ScreenChangeInternal && !steps_.shown_px.isEmpty() && steps_.shown_px != sizePxOf(*this);
  if (is_sharper) {
    keepPicture();
  }
  const bool is_taken = GlView::event(event);
  if (is_sharper) {
    startBlank();
  }
  return is_taken;
}

void SceneWidget::resizeEvent(QResizeEvent* event) {
  keepPicture();
  {
    const QScopedValueRollback resizing(is_resizing_, true);
    GlView::resizeEvent(event);
  }
  startBlank();
  message_->setGeometry(rect());
  if (help_->isShown()) {
    help_->place();
  }
}

void SceneWidget::showEvent(QShowEvent* event) {
  GlView::showEvent(event);
  requestTick();
}

void SceneWidget::mousePressEvent(QMouseEvent* event) {
  gestures_.press(event->button(), event->modifiers(), event->position());
  picker_->press(event->position());
}

void SceneWidget::mouseMoveEvent(QMouseEvent* event) {
  if (!gestures_.isDragging()) {
    picker_->hover(event->position());
  } else if (gestures_.move(event->position(), size(), camera_, now())) {
    onCameraMoved();
  }
}

void SceneWidget::mouseReleaseEvent(QMouseEvent* event) {
  gestures_.release(event->button());
  if (event->button() == Qt::LeftButton) {
    picker_->release(event->position(), event->modifiers().testFlag(Qt::ShiftModifier));
  }
}

void SceneWidget::wheelEvent(QWheelEvent* event) {
  // Some platforms turn a wheel with Alt or Shift into a sideways one.
  const QPoint angle = event->angleDelta();
  const double steps = (angle.y() != 0 ? angle.y() : angle.x()) / kWheelNotch;
  if (steps != 0.0) {
    CameraGestures::wheel(steps, event->modifiers(), event->position(), size(), camera_, now());
    onCameraMoved();
  }
  event->accept();
}

void SceneWidget::keyPressEvent(QKeyEvent* event) {
  const auto command = CameraKeys::command(*event);
  const auto saved = CameraKeys::savedView(*event);
  if (command && obey(*command)) {
    return;
  }
  if (saved && static_cast<std::size_t>(*saved) <= saved_views_.size()) {
    showSavedView(QString::fromStdString(saved_views_[static_cast<std::size_t>(*saved) - 1].name));
  } else if (keys_.press(*event)) {
    if (!event->isAutoRepeat()) {
      walked_s_ = now();
      picker_->label().hide();
      update();
    }
  } else {
    GlView::keyPressEvent(event);
  }
}

void SceneWidget::keyReleaseEvent(QKeyEvent* event) {
  if (keys_.release(*event)) {
    Q_EMIT cameraChanged();
  } else {
    GlView::keyReleaseEvent(event);
  }
}

void SceneWidget::focusOutEvent(QFocusEvent* event) {
  keys_.releaseAll();  // the release goes to somebody else
  GlView::focusOutEvent(event);
}

void SceneWidget::toggleHelp() { help_->setShown(!help_->isShown()); }

/// Returns whether the key was for this view.
bool SceneWidget::obey(CameraCommand command) {
  using enum CameraCommand;
  switch (command) {
    case Home:
      home();
      break;
    case Frame:
      frameSelection();
      break;
    case FrameAll:
      frameAll();
      break;
    case Recenter:
      recenter();
      break;
    case Orbit:
    case XyOrbit:
    case TopDownOrtho:
    case Fly:
      setCameraKind(scenegraph::kCameraKinds[static_cast<int>(command) - static_cast<int>(Orbit)]);
      break;
    case NextFollow:
      setFollow(scenegraph::kFollowModes[(static_cast<std::size_t>(camera_.follow().mode()) + 1) %
                                         std::size(scenegraph::kFollowModes)]);
      break;
    case SaveView:
      saveView();
      break;
    case PickMiddle:
    case MeasureMiddle:
      picker_->pickMiddle(command == MeasureMiddle);
      break;
    case ClearPicks:
      picker_->picks().clear();
      break;
    case Help:
      toggleHelp();
      break;
    case CloseHelp:
      if (!help_->isShown()) {
        return false;
      }
      help_->setShown(false);
      break;
    default:
      return steer(command);
  }
  return true;
}

bool SceneWidget::steer(CameraCommand command) {
  using enum CameraCommand;
  constexpr double kTurn = 1.0 / 24.0;  // of the height of the picture: 7.5 degrees
  constexpr double kPan = 0.1;
  const auto rotate = [this](double right, double down) { camera_.grasp(now()).rotate(right, down, 1.0); };
  const auto pan = [this](double right, double down) { camera_.grasp(now()).pan(right, down, 1.0); };
  switch (command) {
    case FromX:
      lookFrom({1, 0, 0});
      return true;
    case FromY:
      lookFrom({0, 1, 0});
      return true;
    case FromZ:
      lookFrom({0, 0, 1});
      return true;
    case FromMinusX:
      lookFrom({-1, 0, 0});
      return true;
    case FromMinusY:
      lookFrom({0, -1, 0});
      return true;
    case FromMinusZ:
      lookFrom({0, 0, -1});
      return true;
    case TurnLeft:
      rotate(-kTurn, 0.0);
      break;
    case TurnRight:
      rotate(kTurn, 0.0);
      break;
    case TurnUp:
      rotate(0.0, -kTurn);
      break;
    case TurnDown:
      rotate(0.0, kTurn);
      break;
    case PanLeft:
      pan(-kPan, 0.0);
      break;
    case PanRight:
      pan(kPan, 0.0);
      break;
    case PanUp:
      pan(0.0, -kPan);
      break;
    case PanDown:
      pan(0.0, kPan);
      break;
    case ZoomIn:
      camera_.grasp(now()).zoom(1.0);
      break;
    case ZoomOut:
      camera_.grasp(now()).zoom(-1.0);
      break;
    case PaceUp:
      camera_.changePace(1.0);
      break;
    case PaceDown:
      camera_.changePace(-1.0);
      break;
    default:
      return false;
  }
  onCameraMoved();
  return true;
}

void SceneWidget::leaveEvent(QEvent* event) {
  picker_->leave();
  GlView::leaveEvent(event);
}

}  // namespace stillframe::viewer
