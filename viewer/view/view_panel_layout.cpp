// What a ViewPanel is, as a ViewLayout: taken, restored, and kept until data comes.
#include <QSplitter>
#include <QToolButton>
#include <algorithm>
#include <iterator>

#include "scenegraph/layer_list.h"
#include "viewer/layers/layer_panel.h"
#include "viewer/layers/legend_overlay.h"
#include "viewer/pick/view_picks.h"
#include "viewer/view/effect_panel.h"
#include "viewer/view/view_history.h"
#include "viewer/view/view_panel.h"
#include "viewer/widget/scene_widget.h"

namespace stillframe::viewer {

using scenegraph::LayerState;
using scenegraph::ViewLayout;

ViewLayout ViewPanel::layout() const {
  scenegraph::Scene* scene = view_->scene();
  ViewLayout layout;
  if (scene == nullptr && is_waiting_for_scene_) {
    layout = restored_;
  }
  layout.source = restored_.source;
  layout.shows_layers = layers_button_->isChecked();
  layout.shows_effects = effects_button_->isChecked();
  if (panelsWidth() > 0) {
    layout.panel_width = splitter_->sizes().constFirst();
  }
  layout.shows_legend = legend_button_->isChecked();
  layout.effects = view_->effects().toTexts();
  layout.has_smooth_moves = view_->hasSmoothMoves();
  layout.saved_views = view_->savedViews();
  if (scene == nullptr) {
    return layout;
  }
  if (!view_->wantsFraming()) {  // else the camera is not of this recording
    layout.dataset = scene->dataset().name();
  }
  if (scene->isFixedFrameExplicit()) {
    layout.fixed_frame = scene->fixedFrame();
  }
  layout.viewpoint = view_->camera().state();
  layout.is_camera_touched = view_->isCameraTouched();
  layout.layers = scenegraph::layerList(*scene, waiting_);
  layout.picks = view_->picks().marks();
  return layout;
}

void ViewPanel::setEffects(const scenegraph::ViewEffects& effects) {
  effects_->setEffects(effects);
  view_->setEffects(effects);
}

void ViewPanel::restore(const ViewLayout& layout) {
  restored_ = layout;
  layers_button_->setChecked(layout.shows_layers);
  effects_button_->setChecked(layout.shows_effects);
  if (layout.panel_width) {
    splitter_->setSizes({*layout.panel_width, std::max(1, splitter_->width() - *layout.panel_width)});
  }
  setLegendShown(layout.shows_legend);
  refused_lines_.clear();
  scenegraph::ViewEffects effects;
  for (const scenegraph::SettingError& error : effects.fromTexts(layout.effects)) {
    refused_lines_.push_back("effects: " + error.message);
  }
  setEffects(effects);
  view_->setSmoothMoves(layout.has_smooth_moves);
  view_->setSavedViews(layout.saved_views);
  waiting_.clear();
  is_refused_.clear();
  absent_.clear();
  is_waiting_for_scene_ = view_->scene() == nullptr;
  if (!is_waiting_for_scene_) {
    restoreInto(*view_->scene());
  }
  history_->clear();
}

void ViewPanel::restoreInto(scenegraph::Scene& scene) {
  is_waiting_for_scene_ = false;
  scene.setFixedFrame(restored_.fixed_frame);
  takeApplied(scenegraph::applyLayerList(restored_.layers, scene), scene);
  if (restored_.is_camera_touched || restored_.dataset == scene.dataset().name()) {
    view_->restoreViewpoint(restored_.viewpoint, restored_.is_camera_touched);
  } else {  // whatever there is to see, in this recording, the same way
    view_->setViewpoint(restored_.viewpoint);
    view_->resetView();
  }
  view_->picks().restore(restored_.picks);
  layers_->refresh();
  refreshFrames();
  view_->requestTick();
}

void ViewPanel::setLegendShown(bool shown) {
  legend_button_->setChecked(shown);
  legend_->setEnabledByUser(shown);
  legend_->refresh(view_->scene());
}

/// Those that wait for a topic; settings that were refused once are not tried again.
void ViewPanel::applyWaitingLayers() {
  scenegraph::Scene* scene = view_->scene();
  if (scene == nullptr || absent_.empty()) {
    return;
  }
  std::vector<LayerState> to_try;
  std::vector<LayerState> refused_settings;
  for (LayerState& layer : waiting_) {
    (scene->findLayer(layer.id) == nullptr || !is_refused_.contains(layer.id) ? to_try : refused_settings)
        .push_back(std::move(layer));
  }
  const std::size_t count = scene->layers().size();
  takeApplied(scenegraph::applyLayers(to_try, *scene), *scene);
  std::ranges::move(refused_settings, std::back_inserter(waiting_));
  if (scene->layers().size() == count) {
    return;
  }
  std::vector<std::string> order;
  std::ranges::transform(restored_.layers.layers, std::back_inserter(order), &LayerState::id);
  scene->arrangeLayers(order);
}

void ViewPanel::takeApplied(scenegraph::AppliedLayers applied, scenegraph::Scene& scene) {
  const auto addLines = [](const std::vector<scenegraph::Status>& from, std::vector<std::string>& lines) {
    std::ranges::transform(from, std::back_inserter(lines), &scenegraph::Status::message);
  };
  addLines(applied.refused, refused_lines_);
  absent_.clear();
  addLines(applied.absent, absent_);
  waiting_ = std::move(applied.waiting);
  for (const LayerState& layer : waiting_) {
    if (scene.findLayer(layer.id) != nullptr) {
      is_refused_.insert(layer.id);
    }
  }
}

std::vector<std::string> ViewPanel::notRestored() const {
  std::vector<std::string> lines = refused_lines_;
  std::ranges::copy(absent_, std::back_inserter(lines));
  std::ranges::copy(not_added_, std::back_inserter(lines));
  scenegraph::Scene* scene = view_->scene();
  if (scene == nullptr) {
    return lines;
  }
  const tf::TransformBuffer& transforms = *scene->dataset().transforms();
  const auto check = [&](const std::optional<std::string>& frame, const char* what) {
    if (frame && transforms.frameCount() > 0 && !transforms.findFrame(*frame)) {
      lines.push_back(std::string(what) + " '" + *frame + "' is not in '" + scene->dataset().name() + "'");
    }
  };
  check(scene->isFixedFrameExplicit() ? std::optional(scene->fixedFrame()) : std::nullopt, "fixed frame");
  check(view_->camera().displayFrame(), "display frame");
  for (const std::string& frame : scenegraph::framesOf(view_->picks().marks())) {
    if (view_->time() == scene->frames().time() && !scene->frames().fixedFromFrame(frame)) {
      lines.push_back("what is picked in frame '" + frame + "' has no place in '" + scene->fixedFrame() + "' now");
    }
  }
  return lines;
}

}  // namespace stillframe::viewer
