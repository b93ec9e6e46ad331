#include "viewer/pick/view_picker.h"

#include <QElapsedTimer>
#include <cmath>

#include "scenegraph/camera/picking.h"
#include "viewer/pick/hover_label.h"
#include "viewer/pick/view_picks.h"
#include "viewer/widget/scene_widget.h"

namespace stillframe::viewer {
namespace {

constexpr double kHoverReach = 24.0;  // device-independent pixels, as the next two
constexpr double kSamePlace = 4.0;
constexpr double kStill = 3.0;   // farther is a drag
constexpr int kMostHovered = 8;  // names in the label
constexpr double kLongMs = 8.0;
constexpr int kRestMs = 150;

QString lineOf(const scenegraph::PickResult& result) {
  const glm::dvec3& at = result.point_in_fixed;
  const auto number = [](double metres) { return QString::number(metres, 'g', 6); };
  return QStringLiteral("%1  %2 %3  (%4, %5, %6)")
      .arg(QString::fromStdString(result.topic), QString::fromStdString(result.picked.kind),
           QString::fromStdString(result.picked.id), number(at.x), number(at.y), number(at.z));
}

}  // namespace

ViewPicker::ViewPicker(SceneWidget& view)
    : QObject(&view), view_(view), picks_(new ViewPicks(&view)), label_(new HoverLabel(&view)), gate_([this] {
        answer();
      }) {
  rest_.setSingleShot(true);
  rest_.setInterval(kRestMs);
  connect(&rest_, &QTimer::timeout, this, &ViewPicker::answer);
  connect(picks_, &ViewPicks::changed, this, &ViewPicker::onPicksChanged);
}

void ViewPicker::press(QPointF position) {
  pressed_ = position;
  cursor_.reset();
  label_->clearAll();
}

void ViewPicker::hover(QPointF position) {
  scenegraph::Scene* const scene = view_.scene();
  if (scene == nullptr) {
    return;
  }
  const auto picks = scenegraph::pickFrames(scene->frames().buffer(), scene->frames().snapshot(), shown_,
                                            {static_cast<double>(view_.width()), static_cast<double>(view_.height())},
                                            {position.x(), position.y()}, kHoverReach, kMostHovered + 1);
  const QString frame = picks.empty() ? QString() : QString::fromStdString(picks.front().frame);
  // Frames whose origins fall on each other are all named, one below the other.
  QStringList names;
  for (const scenegraph::FramePick& pick : picks) {
    if (pick.distance_px - picks.front().distance_px < kSamePlace) {
      names << (names.size() < kMostHovered ? QString::fromStdString(pick.frame) : tr("..."));
    }
  }
  label_->setFrames(names);
  label_->showAt(position);
  if (frame != frame_) {
    frame_ = frame;
    Q_EMIT view_.frameHovered(frame);
  }
  cursor_ = position;
  if (last_ms_ > kLongMs) {
    rest_.start();
  } else {
    gate_.request();
  }
}

void ViewPicker::hoverThing() {
  if (!cursor_ || !view_.isVisible()) {
    return;
  }
  QElapsedTimer clock;
  clock.start();
  const auto result = view_.pick(*cursor_);
  last_ms_ = static_cast<double>(clock.nsecsElapsed()) * 1e-6;
  label_->setThing(result ? lineOf(*result) : QString());
  label_->showAt(*cursor_);
}

void ViewPicker::release(QPointF position, bool measures) {
  const QPointF moved = position - pressed_;
  if (!(std::hypot(moved.x(), moved.y()) <= kStill)) {
    return;
  }
  ask({.position = position, .measures = measures});
}

void ViewPicker::ask(const Click& click) {
  clicks_.push_back(click);
  answer();
}

/// Of clicks, or of the cursor where none waits.
void ViewPicker::answer() {
  if ((!clicks_.empty() || (cursor_ && view_.isVisible())) && view_.warmPick()) {
    gate_.request();
    return;
  }
  if (clicks_.empty()) {
    hoverThing();
    return;
  }
  while (!clicks_.empty()) {
    const Click click = clicks_.front();
    clicks_.pop_front();
    answerClick(click);
  }
  view_.goOn();
}

void ViewPicker::dropClicks() {
  clicks_.clear();
  view_.goOn();
}

void ViewPicker::answerClick(const Click& click) {
  const bool is_hit = pickAt(click.position, click.measures);
  if (click.is_by_keys) {
    label_->setThing(is_hit ? lineOf(*picks_->selected()) : tr("nothing in the middle of the view"));
    label_->showAt(click.position);
  }
}

/// Returns whether there is something.
bool ViewPicker::pickAt(QPointF position, bool measures) {
  auto result = view_.pick(position);
  const bool is_hit = result.has_value();
  if (is_hit && measures) {
    picks_->measureTo(std::move(*result));
  } else if (is_hit) {
    picks_->select(std::move(*result));
  } else if (!measures) {
    picks_->select(std::nullopt);
  }
  return is_hit;
}

void ViewPicker::pickMiddle(bool measures) {
  const QPointF middle = QRectF(view_.rect()).center();
  label_->clearAll();
  cursor_.reset();
  ask({.position = middle, .measures = measures, .is_by_keys = true});
}

void ViewPicker::leave() {
  label_->clearAll();
  cursor_.reset();
  frame_.clear();
  Q_EMIT view_.frameHovered({});
}

void ViewPicker::clear() {
  label_->clearAll();
  picks_->clear();
  dropClicks();
  last_ms_ = 0.0;
}

/// F frames what was picked; the points go with their frames.
void ViewPicker::onPicksChanged() {
  const auto& picked = picks_->selected();
  view_.setSelection(
      picked ? std::optional(Selection{picked->frame, picked->picked.point_in_frame, picked->picked.radius_m})
             : std::nullopt);
  place();
}

void ViewPicker::showFrame(const scenegraph::CameraView& view) {
  shown_ = view;
  place();
}

void ViewPicker::place() {
  if (view_.scene() != nullptr) {
    picks_->place(*view_.scene(), shown_);
  }
}

}  // namespace stillframe::viewer
