#pragma once

#include <expected>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenegraph/camera/follow.h"
#include "scenegraph/layout/window_layout.h"
#include "scenegraph/passes/view_effects.h"
#include "scenegraph/pipeline/view_pipeline.h"
#include "scenegraph/status.h"
#include "viewer/layers/layer_choices.h"
#include "viewer/widget/view_way.h"
#include "viewer/window/dataset_loader.h"
#include "viewer/window/theme.h"

namespace stillframe::viewer {

/// How an inspector starts.
struct InspectorOptions {
  std::vector<std::filesystem::path> files = {};  ///< opened at once; none: an empty window that waits for a drop
  std::optional<std::string> time = {};           ///< integer ns, "+SECONDS", "start" or "end"; absent: openingTime()
  std::optional<std::string> fixed_frame = {};    ///< absent: chosen automatically
  std::optional<scenegraph::CameraKind> camera = {};  ///< absent: that of the layout, else orbit
  std::optional<std::string> display_frame = {};      ///< absent: the fixed frame
  scenegraph::FollowMode follow = scenegraph::FollowMode::Off;
  LayerChoices layers = {};
  scenegraph::PointWay points = scenegraph::PointWay::Auto;  ///< who draws opaque points
  std::optional<double> point_budget_ms = {};                ///< of a frame; absent: what suits the renderer
  ViewWay way = ViewWay::Auto;                               ///< of views to the screen
  scenegraph::ViewEffects effects = {};                      ///< of views that no layout describes
  std::optional<scenegraph::Layout> layout = {};             ///< the views; what else is said here goes before it
  std::optional<std::filesystem::path> layout_file = {};     ///< where it came from and Save layout writes it to
  int views = 1;
  int width = 1280;  ///< of the window
  int height = 800;
  std::optional<std::filesystem::path> screenshot = {};  ///< save a picture of the complete window there, then quit
  std::optional<Theme> theme = {};                       ///< absent: as chosen last
  bool reports_stalls = false;                           ///< print what kept the window from answering, at the end
};

/// Runs `stillframe view`: makes the application (whose arguments are argc and argv) and a window, until it is closed.
/// Returns the exit code; "NoDisplay" when the display that the environment names does not answer.
std::expected<int, scenegraph::Status> runInspector(int argc, char** argv, const InspectorOptions& options,
                                                    const RecordingOpener& opener);

}  // namespace stillframe::viewer
