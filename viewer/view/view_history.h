#pragma once

#include <QObject>
#include <QString>
#include <QUndoStack>
#include <functional>
#include <optional>
#include <string>

#include "scenegraph/camera/camera_rig.h"
#include "scenegraph/camera/follow.h"
#include "scenegraph/layer_state.h"
#include "scenegraph/settings.h"

namespace stillframe::viewer {

/// Every setting of a view in plain values; not where its camera looks from, which is no setting.
struct ViewSettings {
  scenegraph::LayerList layers;
  std::optional<std::string> fixed_frame;  ///< nullopt: automatic
  std::optional<std::string> display_frame;
  scenegraph::FollowMode follow = scenegraph::FollowMode::Off;
  scenegraph::CameraKind camera = scenegraph::CameraKind::Orbit;
  scenegraph::SettingTexts effects;
  bool shows_legend = true;

  friend bool operator==(const ViewSettings&, const ViewSettings&) = default;
};

/// Undo and redo for the settings of one view.
///
/// Whoever lets the user change something calls note() after it; what then differs from what was known before is the
/// step, whichever way it came about. What changes by itself (a topic appears) is taken over by adopt(). GUI thread.
class ViewHistory : public QObject {
  Q_OBJECT

 public:
  /// Reads the settings of the view.
  using Read = std::function<ViewSettings()>;
  /// Changes in the view what differs between the first and the second.
  using Change = std::function<void(const ViewSettings&, const ViewSettings&)>;

  ViewHistory(Read read, Change change, QObject* parent = nullptr);

  [[nodiscard]] QUndoStack& stack() noexcept { return stack_; }
  /// `what` names the step for people. Steps of one `gesture`, a slider's say, less than a second and a half apart, are
  /// one; "" is none.
  void note(const QString& what, const QString& gesture = {});
  void adopt();
  /// Forgets all steps; what there is now is where it begins.
  void clear();
  /// What is known; for callers that can tell cheaply whether there is something to note.
  [[nodiscard]] const ViewSettings& known() const noexcept { return known_; }

 private:
  class Step;

  Read read_;
  Change change_;
  ViewSettings known_;
  bool is_going_ = false;  // to a step: what the view then tells is no step of the user's
  QUndoStack stack_;
};

}  // namespace stillframe::viewer
