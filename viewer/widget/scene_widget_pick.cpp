// What lies under the cursor of SceneWidget: said beside it, picked by a click, measured between two.
#include <cmath>
#include <limits>

#include "viewer/pick/hover_label.h"
#include "viewer/pick/view_picks.h"
#include "viewer/widget/scene_widget.h"

namespace stillframe::viewer {
namespace {

constexpr double kHoverReach = 24.0;  // device-independent pixels, as the next
constexpr double kSamePlace = 4.0;
constexpr int kMostHovered = 8;  // names in the label

QString lineOf(const scenegraph::PickResult& result) {
  const glm::dvec3& at = result.point_in_fixed;
  const auto number = [](double metres) { return QString::number(metres, 'g', 6); };
  return QStringLiteral("%1  %2 %3  (%4, %5, %6)")
      .arg(QString::fromStdString(result.topic), QString::fromStdString(result.picked.kind),
           QString::fromStdString(result.picked.id), number(at.x), number(at.y), number(at.z));
}

}  // namespace

std::expected<scenegraph::PickResult, scenegraph::PickError> SceneWidget::pick(QPointF position) {
  const double ratio = devicePixelRatioF();
  const double x = std::floor(position.x() * ratio);
  const double y = std::floor(position.y() * ratio);
  constexpr double kMost = std::numeric_limits<int>::max() / 2;
  if (scene_ == nullptr || pipeline_ == nullptr || !is_context_usable_ ||
      !(std::abs(x) < kMost && std::abs(y) < kMost)) {
    return std::unexpected(scenegraph::PickError::NothingThere);
  }
  makeCurrent();
  const auto hits = pipeline_->pick(static_cast<int>(x), static_cast<int>(y));
  auto result = scenegraph::describeHits(*scene_, hits);
  doneCurrent();
  return result;
}

/// Names of frames at once; the thing when the event loop comes to it, for the latest place of the cursor alone.
void SceneWidget::hover(QPointF position) {
  if (scene_ == nullptr || !is_context_usable_) {
    return;
  }
  const auto picks = scenegraph::pickFrames(scene_->frames().buffer(), scene_->frames().snapshot(), shownView(),
                                            {static_cast<double>(width()), static_cast<double>(height())},
                                            {position.x(), position.y()}, kHoverReach, kMostHovered + 1);
  const QString frame = picks.empty() ? QString() : QString::fromStdString(picks.front().frame);
  // Frames whose origins fall on each other are all named, one below the other.
  QStringList names;
  for (const scenegraph::FramePick& pick : picks) {
    if (pick.distance_px - picks.front().distance_px < kSamePlace) {
      names << (names.size() < kMostHovered ? QString::fromStdString(pick.frame) : tr("..."));
    }
  }
  hover_label_->setFrames(names);
  hover_label_->showAt(position);
  if (frame != hovered_frame_) {
    hovered_frame_ = frame;
    Q_EMIT frameHovered(frame);
  }
  hovered_ = position;
  hover_gate_.request();
}

void SceneWidget::hoverThing() {
  if (!hovered_ || gestures_.isDragging() || !isVisible()) {
    return;
  }
  const auto result = pick(*hovered_);
  hover_label_->setThing(result ? lineOf(*result) : QString());
  hover_label_->showAt(*hovered_);
}

void SceneWidget::click(QPointF position, bool measures) {
  auto result = pick(position);
  if (!result) {
    if (!measures) {
      picks_->select(std::nullopt);
    }
  } else if (measures) {
    picks_->measureTo(std::move(*result));
  } else {
    picks_->select(std::move(*result));
  }
}

/// F frames what was picked; the points go with their frames.
void SceneWidget::onPicksChanged() {
  const auto& picked = picks_->selected();
  selection_ = picked ? std::optional(Selection{picked->frame, picked->picked.point_in_frame, picked->picked.radius_m})
                      : std::nullopt;
  placePicks();
}

void SceneWidget::placePicks() {
  if (scene_ != nullptr) {
    picks_->place(*scene_, shownView());
  }
}

}  // namespace stillframe::viewer
