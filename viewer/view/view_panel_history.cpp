// Undo and redo of a ViewPanel's settings: what they are, and how they are changed back.
#include <QComboBox>
#include <QKeySequence>
#include <QShortcut>
#include <QToolButton>
#include <cstdint>

#include "scenegraph/layer_list.h"
#include "viewer/frames/frame_picker.h"
#include "viewer/layers/layer_panel.h"
#include "viewer/view/camera_bar.h"
#include "viewer/view/effect_panel.h"
#include "viewer/view/view_history.h"
#include "viewer/view/view_panel.h"
#include "viewer/widget/scene_widget.h"

namespace stillframe::viewer {

void ViewPanel::connectHistory() {
  history_ =
      new ViewHistory([this] { return settings(); },
                      [this](const ViewSettings& from, const ViewSettings& to) { changeSettings(from, to); }, this);
  connect(layers_, &LayerPanel::changed, history_, &ViewHistory::note);
  connect(effects_, &EffectPanel::changed, history_,
          [this] { history_->note(tr("effects"), QStringLiteral("effects")); });
  connect(legend_button_, &QToolButton::clicked, history_, [this] { history_->note(tr("legend")); });
  connect(picker_, &FramePicker::picked, history_, [this] { history_->note(tr("fixed frame")); });
  connect(view_, &SceneWidget::cameraChanged, history_, [this] {
    // Told of every move; a move is no step.
    const scenegraph::ViewCamera& camera = view_->camera();
    const ViewSettings& known = history_->known();
    if (camera.rig().kind() != known.camera) {
      history_->note(tr("camera"));
    } else if (camera.follow().mode() != known.follow || camera.displayFrame() != known.display_frame) {
      history_->note(tr("follow"));
    }
  });
  connect(view_, &SceneWidget::sceneUpdated, history_, [this] {
    const std::uint64_t revision = view_->scene()->settingsRevision();
    if (revision != adopted_revision_) {
      adopted_revision_ = revision;
      history_->adopt();
    }
  });
  const auto bind = [this](const QKeySequence& keys, auto action) {
    auto* shortcut = new QShortcut(keys, this);
    shortcut->setContext(Qt::WidgetWithChildrenShortcut);
    connect(shortcut, &QShortcut::activated, &history_->stack(), action);
  };
  bind(Qt::CTRL | Qt::Key_Z, &QUndoStack::undo);
  bind(Qt::CTRL | Qt::SHIFT | Qt::Key_Z, &QUndoStack::redo);
}

ViewSettings ViewPanel::settings() const {
  ViewSettings settings;
  settings.effects = view_->effects().toTexts();
  settings.shows_legend = legend_button_->isChecked();
  settings.display_frame = view_->camera().displayFrame();
  settings.follow = view_->camera().follow().mode();
  settings.camera = view_->camera().rig().kind();
  if (const scenegraph::Scene* scene = view_->scene()) {
    settings.layers = scenegraph::layerList(*scene);
    if (scene->isFixedFrameExplicit()) {
      settings.fixed_frame = scene->fixedFrame();
    }
  }
  return settings;
}

void ViewPanel::changeSettings(const ViewSettings& from, const ViewSettings& to) {
  if (from.effects != to.effects) {
    scenegraph::ViewEffects effects;
    (void)effects.fromTexts(to.effects);  // taken from effects
    setEffects(effects);
  }
  if (from.shows_legend != to.shows_legend) {
    setLegendShown(to.shows_legend);
  }
  scenegraph::Scene* const scene = view_->scene();
  if (scene == nullptr) {
    return;
  }
  const scenegraph::AppliedLayers applied = scenegraph::changeLayerList(from.layers, to.layers, *scene);
  for (const auto* const statuses : {&applied.refused, &applied.absent}) {
    for (const scenegraph::Status& status : *statuses) {
      Q_EMIT refused(QString::fromStdString(status.message));
    }
  }
  if (from.fixed_frame != to.fixed_frame) {
    view_->setFixedFrame(to.fixed_frame);
  }
  if (from.camera != to.camera) {
    view_->setCameraKind(to.camera);
  }
  if (from.display_frame != to.display_frame) {
    view_->setDisplayFrame(to.display_frame);
  }
  if (from.follow != to.follow) {
    view_->setFollow(to.follow);
  }
  layers_->refresh();
  refreshFrames();
  view_->requestTick();
}

}  // namespace stillframe::viewer
