// What lies at a place of SceneWidget.
#include <cmath>
#include <limits>
#include <utility>

#include "viewer/pick/view_picker.h"
#include "viewer/widget/scene_widget.h"

namespace stillframe::viewer {

ViewPicks& SceneWidget::picks() noexcept { return picker_->picks(); }

std::expected<scenegraph::PickResult, scenegraph::PickError> SceneWidget::pick(QPointF position) {
  const double ratio = devicePixelRatioF();
  const double x = std::floor(position.x() * ratio);
  const double y = std::floor(position.y() * ratio);
  constexpr double kMost = 0.5 * std::numeric_limits<int>::max();
  if (scene_ == nullptr || pipeline_ == nullptr || !is_context_usable_ || isLent() ||
      !(std::abs(x) < kMost && std::abs(y) < kMost)) {
    return std::unexpected(scenegraph::PickError::NothingThere);
  }
  makeCurrent();
  const auto hits = pipeline_->pick(static_cast<int>(x), static_cast<int>(y));
  auto result = scenegraph::describeHits(*scene_, hits);
  doneCurrent();
  return result;
}

bool SceneWidget::warmPick() {
  if (!is_software_ || scene_ == nullptr || pipeline_ == nullptr || !is_context_usable_ || isLent()) {
    return false;
  }
  makeCurrent();
  const bool was_cold = pipeline_->warmPick();
  doneCurrent();
  return was_cold;
}

void SceneWidget::goOn() {
  if (std::exchange(steps_.has_put_tick, false)) {
    requestTick();
  }
  if (steps_.is_wanted) {
    askForFrame();
  }
}

}  // namespace stillframe::viewer
