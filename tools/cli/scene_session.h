#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/camera/follow.h"
#include "scenegraph/executor.h"
#include "scenegraph/export/osgt_export.h"
#include "scenegraph/pipeline/gl_context_info.h"
#include "scenegraph/scene.h"
#include "tools/cli/view_options.h"
#include "tools/ingest/recording.h"

namespace stillframe::cli {

/// A recording, loaded, and the scene of one instant of it, complete: background work runs inside.
class SceneSession {
 public:
  /// Refuses a time outside the recording, an unknown frame, topic or setting; each error names what there is.
  [[nodiscard]] static Result<std::unique_ptr<SceneSession>> make(const ViewOptions& options);

  [[nodiscard]] scenegraph::Scene& scene() noexcept { return *scene_; }
  [[nodiscard]] tf::TimePoint time() const noexcept { return time_; }
  /// Goes to another instant, which need not lie within the recording.
  void showTime(tf::TimePoint time);
  /// Heeds what the context that will draw the scene can do.
  void setContext(const scenegraph::GlContextInfo& info);
  /// From the eye that was asked for, else one that sees all of it from above at an angle. It was placed at the first
  /// instant, and has gone along with the followed frame since.
  /// `turn_rad` turns it about the vertical through what it looks at, counterclockwise from above.
  [[nodiscard]] scenegraph::CameraView camera(double turn_rad = 0.0) const;
  /// What of the layout could not be applied to this recording, a line each.
  [[nodiscard]] const std::vector<std::string>& layoutNotes() const noexcept { return layout_notes_; }
  /// What an exported file says of itself.
  [[nodiscard]] scenegraph::ExportInfo exportInfo() const;

 private:
  explicit SceneSession(ViewOptions options) : options_(std::move(options)) {}
  void takeLayout();
  Result<void> chooseTime();
  Result<void> addLayers();
  [[nodiscard]] std::string layerRefusal(const std::string& id, const scenegraph::Status& status) const;
  Result<void> chooseFrame();
  Result<void> applyLayers();
  void notePicks();
  Result<void> placeCamera();
  [[nodiscard]] scenegraph::Follow::Pose followedPose() const;
  void updateFully();

  ViewOptions options_;
  std::unique_ptr<ingest::Recording> recording_;
  std::unique_ptr<scenegraph::Executor> executor_;
  std::unique_ptr<scenegraph::Scene> scene_;
  tf::TimePoint time_;
  scenegraph::CameraRig rig_;
  scenegraph::Follow follow_;
  std::vector<std::string> layout_notes_;
};

}  // namespace stillframe::cli
