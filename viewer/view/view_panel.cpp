#include "viewer/view/view_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QSplitter>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "nodes/tf_axes/frame_list.h"
#include "viewer/frames/frame_memory.h"
#include "viewer/frames/frame_picker.h"
#include "viewer/layers/layer_panel.h"
#include "viewer/layers/layer_tree.h"
#include "viewer/layers/legend_overlay.h"
#include "viewer/view/camera_bar.h"
#include "viewer/view/effect_panel.h"
#include "viewer/view/narrow_bar.h"
#include "viewer/view/view_grip.h"
#include "viewer/view/view_history.h"
#include "viewer/widget/scene_widget.h"
#include "viewer/window/icons.h"

namespace stillframe::viewer {
namespace {

constexpr int kLayerPanelWidth = 322;
constexpr int kLeastFramePickerWidth = 36;
constexpr int kMarkHeight = 2;
constexpr QSize kLeastPicture(150, 90);

/// A label that is shown whole, or not at all where there is no room.
class WholeLabel : public QLabel {
 public:
  using QLabel::QLabel;

 protected:
  void paintEvent(QPaintEvent* event) override {
    if (width() >= sizeHint().width()) {
      QLabel::paintEvent(event);
    }
  }
};

}  // namespace

ViewPanel::ViewPanel(QWidget* parent)
    : QWidget(parent), mark_(new QWidget(this)), splitter_(new QSplitter(Qt::Horizontal, this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);

  mark_->setObjectName(QStringLiteral("mark"));
  mark_->setFixedHeight(kMarkHeight);
  mark_->setAutoFillBackground(true);
  layout->addWidget(mark_);
  auto* bar = new NarrowBar(this);
  auto* bar_layout = new QHBoxLayout(bar);
  bar_layout->setContentsMargins(4, 0, 4, 2);
  bar_layout->setSpacing(2);
  auto* grip = new ViewGrip(bar);
  bar_layout->addWidget(grip);
  layers_button_ = addButton(*bar, QStringLiteral("layers"), transportIcon(TransportIcon::Layers), tr("Layers"));
  layers_button_->setCheckable(true);
  layers_button_->setChecked(true);
  effects_button_ = addButton(*bar, QStringLiteral("effects"), transportIcon(TransportIcon::Effects),
                              tr("Effects: shading, tone mapping, anti-aliasing"));
  effects_button_->setCheckable(true);
  legend_button_ = addButton(*bar, QStringLiteral("legendButton"), transportIcon(TransportIcon::Legend),
                             tr("Legend: what the colours of values mean"));
  legend_button_->setCheckable(true);
  legend_button_->setChecked(true);
  auto* label = new WholeLabel(tr("Fixed frame"), bar);
  bar_layout->addSpacing(4);
  bar_layout->addWidget(label);
  label->setMinimumWidth(1);  // where views stand side by side, they shrink before the window has to grow
  picker_ = new FramePicker(tr("Fixed frame"), tr("the frame that stands still"), bar);
  picker_->setObjectName(QStringLiteral("fixedFrame"));
  picker_->setMinimumWidth(kLeastFramePickerWidth);
  bar_layout->addWidget(picker_);
  auto* place_of_camera_bar = new QHBoxLayout;
  bar_layout->addLayout(place_of_camera_bar, 1);
  auto* recenter = addButton(*bar, QStringLiteral("recenter"), transportIcon(TransportIcon::Recenter),
                             tr("Look at everything (Home)"));
  auto* split_right = addButton(*bar, QStringLiteral("splitRight"), transportIcon(TransportIcon::SplitRight),
                                tr("Duplicate this view to the right"));
  auto* split_below = addButton(*bar, QStringLiteral("splitBelow"), transportIcon(TransportIcon::SplitBelow),
                                tr("Duplicate this view below"));
  auto* detach = addButton(*bar, QStringLiteral("detach"), transportIcon(TransportIcon::Detach),
                           tr("Move this view into a window of its own"));
  auto* close = addButton(*bar, QStringLiteral("close"), transportIcon(TransportIcon::Close), tr("Close this view"));
  arranging_ = {grip, split_right, split_below, detach, close};
  bar->spare({detach, split_below, split_right, effects_button_, legend_button_});
  layout->addWidget(bar);

  splitter_->setChildrenCollapsible(true);
  auto* side = new QSplitter(Qt::Vertical, splitter_);
  layers_ = new LayerPanel(side);
  layers_->setObjectName(QStringLiteral("layerPanel"));
  effects_ = new EffectPanel(side);
  effects_->setObjectName(QStringLiteral("effectPanel"));
  effects_->setVisible(false);
  view_ = new SceneWidget(splitter_);
  // NOLINTNEXTLINE(cppcoreguidelines-prefer-member-initializer): after what it stands on
  legend_ = new LegendOverlay(*view_);
  camera_bar_ = new CameraBar(*view_, bar);
  camera_bar_->setBar(*bar);
  place_of_camera_bar->addWidget(camera_bar_);
  view_->setMinimumSize(kLeastPicture);
  splitter_->setCollapsible(1, false);
  splitter_->setStretchFactor(0, 0);
  splitter_->setStretchFactor(1, 1);
  splitter_->setSizes({kLayerPanelWidth, 3 * kLayerPanelWidth});
  layout->addWidget(splitter_, 1);

  const auto show_panels = [this, side] {
    layers_->setVisible(layers_button_->isChecked());
    effects_->setVisible(effects_button_->isChecked());
    side->setVisible(layers_button_->isChecked() || effects_button_->isChecked());
  };
  connect(layers_button_, &QToolButton::toggled, this, show_panels);
  connect(effects_button_, &QToolButton::toggled, this, show_panels);
  connect(legend_button_, &QToolButton::toggled, this, &ViewPanel::setLegendShown);
  connect(effects_, &EffectPanel::changed, view_, [this] { view_->setEffects(effects_->effects()); });
  connect(effects_, &EffectPanel::refused, this, &ViewPanel::refused);
  connect(recenter, &QToolButton::clicked, view_, &SceneWidget::home);
  connect(split_right, &QToolButton::clicked, this, [this] { Q_EMIT splitRequested(Qt::Horizontal); });
  connect(split_below, &QToolButton::clicked, this, [this] { Q_EMIT splitRequested(Qt::Vertical); });
  connect(detach, &QToolButton::clicked, this, &ViewPanel::detachRequested);
  connect(grip, &ViewGrip::dragged, this, &ViewPanel::dragRequested);
  connect(close, &QToolButton::clicked, this, &ViewPanel::closeRequested);
  connect(picker_, &FramePicker::picked, this, &ViewPanel::pickFixedFrame);
  connect(layers_, &LayerPanel::changed, view_, [this] { view_->requestTick(); });
  connect(layers_, &LayerPanel::refused, this, &ViewPanel::refused);
  connect(view_, &SceneWidget::refused, this, &ViewPanel::refused);
  connect(view_, &SceneWidget::sceneUpdated, this, [this] {
    layers_->refresh();
    legend_->refresh(view_->scene());
    refreshFrames();
  });
  connect(layers_, &LayerPanel::drawTimesRequested, view_, &SceneWidget::measureDrawTimes);
  connect(view_, &SceneWidget::drawTimesMeasured, &layers_->tree(), &LayerTree::setDrawTimes);
  connectHistory();
}

ViewPanel::~ViewPanel() {
  layers_->setScene(nullptr);  // before the view takes its scene along
}

QToolButton* ViewPanel::addButton(QWidget& bar, const QString& name, const QIcon& icon, const QString& tip) {
  auto* button = new QToolButton(&bar);
  button->setObjectName(name);
  button->setIcon(icon);
  button->setToolTip(tip);
  button->setAutoRaise(true);
  button->setFocusPolicy(Qt::NoFocus);
  bar.layout()->addWidget(button);
  return button;
}

int ViewPanel::panelsWidth() const {
  return splitter_->widget(0)->isVisible() ? splitter_->sizes().constFirst() + splitter_->handleWidth() : 0;
}

void ViewPanel::narrowPanels(int picture_width) {
  const int lacking = picture_width - view_->width();
  QList<int> sizes = splitter_->sizes();
  if (panelsWidth() > 0 && lacking > 0) {
    sizes[0] = std::max(sizes[0] - lacking, 1);
    sizes[1] = picture_width;
    splitter_->setSizes(sizes);
  }
}

void ViewPanel::hidePanels() {
  layers_button_->setChecked(false);
  effects_button_->setChecked(false);
}

void ViewPanel::setMarked(bool marked) { mark_->setBackgroundRole(marked ? QPalette::Highlight : QPalette::Window); }

void ViewPanel::setArrangeable(bool arrangeable) {
  for (QWidget* const widget : arranging_) {
    widget->setVisible(arrangeable);
  }
}

void ViewPanel::setDataset(std::shared_ptr<scenegraph::Dataset> dataset, scenegraph::Executor& executor,
                           const LayerChoices& choices) {
  layers_->setScene(nullptr);
  view_->setDataset(std::move(dataset), executor);
  if (view_->scene() != nullptr && memory_ != nullptr) {
    view_->scene()->setPreferredFrame(memory_->recall(view_->scene()->dataset().name()));
  }
  choices_ = choices;
  is_choice_applied_.assign(choices_.layers.size(), false);
  waiting_.clear();
  is_refused_.clear();
  absent_.clear();
  addWantedLayers();
  layers_->setScene(view_->scene());
  legend_->refresh(view_->scene());
  refreshFrames();
  if (is_waiting_for_scene_ && view_->scene() != nullptr) {
    restoreInto(*view_->scene());
  }
  history_->clear();
}

void ViewPanel::addWantedLayers() {
  scenegraph::Scene* scene = view_->scene();
  if (scene == nullptr) {
    return;
  }
  if (!choices_.only) {
    scene->addDefaultLayers();
  }
  not_added_.clear();
  for (std::size_t i = 0; i < choices_.layers.size(); ++i) {
    const LayerChoice& choice = choices_.layers[i];
    if (is_choice_applied_[i]) {
      continue;
    }
    const auto slot = scene->addLayer(choice.id);
    if (!slot) {
      not_added_.push_back(slot.error().message);
      continue;  // the topic may come while the file loads
    }
    is_choice_applied_[i] = true;
    if (const auto applied = scenegraph::applyLayerSettings(choice.settings, **slot); !applied) {
      Q_EMIT refused(QString::fromStdString(choice.id + ": " + applied.error().message));
    }
  }
}

void ViewPanel::takeGrowth() {
  addWantedLayers();
  applyWaitingLayers();
  layers_->refresh();
  refreshFrames();
  view_->requestTick();
}

void ViewPanel::homeUnlessTouched() {
  if (!view_->endRestoring() && !view_->isCameraTouched()) {
    view_->resetView();
  }
}

void ViewPanel::refreshFrames() {
  scenegraph::Scene* scene = view_->scene();
  if (scene == nullptr) {
    return;
  }
  const tf::TransformBuffer& buffer = *scene->dataset().transforms();
  if (buffer.frameCount() != static_cast<std::size_t>(picker_->frameCount())) {
    picker_->setFrames(buffer.frames());
  }
  picker_->setCurrent(scene->isFixedFrameExplicit() ? std::optional(scene->fixedFrame()) : std::nullopt,
                      scene->automaticFrame());
  camera_bar_->refresh();
}

/// By hand: other views of this source begin with it from now on.
void ViewPanel::pickFixedFrame(const std::optional<std::string>& frame) {
  scenegraph::Scene* scene = view_->scene();
  if (scene != nullptr) {
    if (memory_ != nullptr) {
      memory_->remember(scene->dataset().name(), frame);
    }
    if (!frame) {
      scene->setPreferredFrame(std::nullopt);  // automatic was asked for, and means what it says
    }
  }
  view_->setFixedFrame(frame);
  refreshFrames();
  view_->setFocus();
}

ViewPanel::FrameNames ViewPanel::hiddenFrames() const {
  scenegraph::Scene* scene = view_->scene();
  const scenegraph::LayerSlot* axes = scene == nullptr ? nullptr : scene->findLayer("tf");
  if (axes == nullptr) {
    return {};
  }
  const scenegraph::SettingTexts settings = axes->layer->settings();
  const auto found = settings.find("hidden_frames");
  return found == settings.end() ? FrameNames() : nodes::splitFrameNames(found->second);
}

void ViewPanel::setHiddenFrames(const FrameNames& hidden) {
  scenegraph::Scene* scene = view_->scene();
  scenegraph::LayerSlot* axes = scene == nullptr ? nullptr : scene->findLayer("tf");
  if (axes == nullptr) {
    return;
  }
  if (const auto applied = axes->layer->applySettings({{"hidden_frames", nodes::joinFrameNames(hidden)}}); !applied) {
    Q_EMIT refused(QString::fromStdString("tf: " + applied.error().message));
  }
  layers_->refresh();
  view_->requestTick();
  history_->note(tr("frames shown"));
}

}  // namespace stillframe::viewer
