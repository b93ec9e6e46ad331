#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scenegraph/camera/view_camera.h"
#include "scenegraph/layer_list.h"
#include "scenegraph/passes/view_effects.h"
#include "scenegraph/scene.h"
#include "viewer/layers/layer_choices.h"

class QSplitter;
class QToolButton;

namespace stillframe::viewer {

class CameraBar;
class EffectPanel;
class FrameMemory;
class FramePicker;
class LayerPanel;
class SceneWidget;

/// All that makes a view what it is, in plain values: what a copy of it takes over, and what is saved and restored.
struct ViewState {
  std::optional<std::string> fixed_frame;
  scenegraph::ViewpointState viewpoint;
  bool is_camera_touched = false;  ///< false: whatever there is to see is in sight
  std::vector<scenegraph::SavedView> saved_views;
  bool has_smooth_moves = true;
  scenegraph::LayerList layers;
  bool shows_layers = true;
  scenegraph::ViewEffects effects;  ///< toTexts() and fromTexts() for layouts
  bool shows_effects = false;
};

/// A view: SceneWidget, tool bar and layer panel. Each has a Scene of its own: fixed frame, layers, settings, camera.
/// GUI thread.
class ViewPanel : public QWidget {
  Q_OBJECT

 public:
  explicit ViewPanel(QWidget* parent = nullptr);
  ~ViewPanel() override;

  /// Shows `dataset` with the layers of `choices`, in the state of a fresh view. `executor` must outlive the panel.
  void setDataset(std::shared_ptr<scenegraph::Dataset> dataset, scenegraph::Executor& executor,
                  const LayerChoices& choices);
  /// What the fixed frame of a new dataset is taken from, and where a choice by hand goes; must outlive the panel.
  void setFrameMemory(FrameMemory& memory) { memory_ = &memory; }
  /// The dataset has more topics, frames or messages.
  void takeGrowth();
  /// Looks at all data again, unless the camera was moved by hand.
  void homeUnlessTouched();

  /// Frames that the axes leave out.
  using FrameNames = std::set<std::string, std::less<>>;
  [[nodiscard]] FrameNames hiddenFrames() const;
  void setHiddenFrames(const FrameNames& hidden);

  void setEffects(const scenegraph::ViewEffects& effects);

  [[nodiscard]] ViewState state() const;
  void setState(const ViewState& state);

  [[nodiscard]] SceneWidget& view() noexcept { return *view_; }
  [[nodiscard]] FramePicker& framePicker() noexcept { return *picker_; }
  [[nodiscard]] CameraBar& cameraBar() noexcept { return *camera_bar_; }
  [[nodiscard]] LayerPanel& layerPanel() noexcept { return *layers_; }
  [[nodiscard]] EffectPanel& effectPanel() noexcept { return *effects_; }

 Q_SIGNALS:
  void splitRequested(Qt::Orientation orientation);
  void closeRequested();
  void refused(const QString& message);

 private:
  QToolButton* addButton(QWidget& bar, const QString& name, const QIcon& icon, const QString& tip);
  void addWantedLayers();
  void refreshFrames();
  void pickFixedFrame(const std::optional<std::string>& frame);

  SceneWidget* view_ = nullptr;
  FramePicker* picker_ = nullptr;
  CameraBar* camera_bar_ = nullptr;
  LayerPanel* layers_ = nullptr;
  EffectPanel* effects_ = nullptr;
  QSplitter* splitter_ = nullptr;
  QToolButton* layers_button_ = nullptr;
  QToolButton* effects_button_ = nullptr;
  FrameMemory* memory_ = nullptr;
  LayerChoices choices_;
  std::vector<bool> is_choice_applied_;
};

}  // namespace stillframe::viewer
