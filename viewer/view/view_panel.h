#pragma once

#include <QWidget>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scenegraph/layer_list.h"
#include "scenegraph/layout/view_layout.h"
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
class LegendOverlay;
class SceneWidget;
class ViewHistory;
struct ViewSettings;

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
  /// Everything is loaded: looks at all data again, unless the camera was moved by hand or restored.
  void homeUnlessTouched();

  /// Frames that the axes leave out.
  using FrameNames = std::set<std::string, std::less<>>;
  [[nodiscard]] FrameNames hiddenFrames() const;
  void setHiddenFrames(const FrameNames& hidden);

  void setEffects(const scenegraph::ViewEffects& effects);
  /// Whether the colours' legends lie over the picture, of the layers that have theirs on.
  void setLegendShown(bool shown);
  /// Whether there are a grip, and buttons to split, detach and close the view; not where the host arranges it. On at
  /// first.
  void setArrangeable(bool arrangeable);

  /// A line above the view in the colour of what is selected: of several it is the active one.
  void setMarked(bool marked);

  /// Of the layers and effects beside the picture, where they are shown.
  [[nodiscard]] int panelsWidth() const;
  void hidePanels();
  /// As far as they can be, so that the picture is as wide as that.
  void narrowPanels(int picture_width);

  /// All that makes the view what it is: what a copy of it takes over, and what is saved.
  [[nodiscard]] scenegraph::ViewLayout layout() const;
  /// Takes that over. What needs topics or frames that are not there (yet) waits for them, and is saved again.
  void restore(const scenegraph::ViewLayout& layout);
  /// What of the restored layout or of the choices was refused, or waits in vain so far, a line each.
  [[nodiscard]] std::vector<std::string> notRestored() const;

  [[nodiscard]] SceneWidget& view() noexcept { return *view_; }
  [[nodiscard]] FramePicker& framePicker() noexcept { return *picker_; }
  [[nodiscard]] CameraBar& cameraBar() noexcept { return *camera_bar_; }
  [[nodiscard]] LayerPanel& layerPanel() noexcept { return *layers_; }
  [[nodiscard]] EffectPanel& effectPanel() noexcept { return *effects_; }
  /// Undo and redo of every setting of the view and its layers: Ctrl+Z and Ctrl+Shift+Z within it.
  [[nodiscard]] ViewHistory& history() noexcept { return *history_; }
  [[nodiscard]] LegendOverlay& legend() noexcept { return *legend_; }

 Q_SIGNALS:
  void splitRequested(Qt::Orientation orientation);
  /// Into a window of its own.
  void detachRequested();
  /// The user drags the view by its grip; the button is down.
  void dragRequested();
  void closeRequested();
  void refused(const QString& message);

 private:
  QToolButton* addButton(QWidget& bar, const QString& name, const QIcon& icon, const QString& tip);
  void addWantedLayers();
  void refreshFrames();
  void connectHistory();
  [[nodiscard]] ViewSettings settings() const;
  void changeSettings(const ViewSettings& from, const ViewSettings& to);
  void pickFixedFrame(const std::optional<std::string>& frame);
  void restoreInto(scenegraph::Scene& scene);
  void applyWaitingLayers();
  void takeApplied(scenegraph::AppliedLayers applied, scenegraph::Scene& scene);

  SceneWidget* view_ = nullptr;
  FramePicker* picker_ = nullptr;
  CameraBar* camera_bar_ = nullptr;
  LayerPanel* layers_ = nullptr;
  EffectPanel* effects_ = nullptr;
  LegendOverlay* legend_ = nullptr;
  ViewHistory* history_ = nullptr;
  std::uint64_t adopted_revision_ = 0;
  QWidget* mark_ = nullptr;
  QSplitter* splitter_ = nullptr;
  QToolButton* layers_button_ = nullptr;
  QToolButton* effects_button_ = nullptr;
  QToolButton* legend_button_ = nullptr;
  std::vector<QWidget*> arranging_;  // grip and buttons
  FrameMemory* memory_ = nullptr;
  LayerChoices choices_;
  std::vector<bool> is_choice_applied_;
  std::vector<std::string> not_added_;           // why choices are not
  scenegraph::ViewLayout restored_;              // the one that came last, as it came
  bool is_waiting_for_scene_ = false;            // all of restored_ does
  std::vector<scenegraph::LayerState> waiting_;  // of its layers
  FrameNames is_refused_;                        // ids of those that wait for settings only
  std::vector<std::string> refused_lines_;
  std::vector<std::string> absent_;  // those without a topic, a line each
};

}  // namespace stillframe::viewer
