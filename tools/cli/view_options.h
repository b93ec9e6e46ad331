#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/camera/follow.h"
#include "scenegraph/pipeline/view_pipeline.h"
#include "tools/cli/cli_error.h"
#include "tools/cli/layer_argument.h"
#include "tools/cli/layout_argument.h"
#include "tools/cli/recording_options.h"
#include "tools/cli/time_argument.h"
#include "tools/cli/value_arguments.h"

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11 has it so
class App;
}

namespace stillframe::cli {

/// What `render`, `export` and the osgDB plugin are asked to show.
struct ViewOptions {
  RecordingOptions recording;
  TimeArgument time;
  std::optional<std::string> fixed_frame;
  std::vector<LayerArgument> layers;
  bool only_named_layers = false;
  std::optional<scenegraph::ViewLayout> layout;  ///< what all that is not said here is taken from
  bool is_camera_named = false;                  ///< the camera is said here, not by the layout
  std::optional<glm::dvec3> eye;      ///< in the frame that the camera lives in: the fixed frame unless it follows
  std::optional<glm::dvec3> look_at;  ///< in the same
  double vertical_fov_deg = 50.0;
  scenegraph::CameraKind camera = scenegraph::CameraKind::Orbit;
  std::optional<double> ortho_height_m;     ///< of the picture, for the camera without perspective
  std::optional<std::string> follow_frame;  ///< absent: none
  scenegraph::FollowMode follow = scenegraph::FollowMode::Off;
  PictureSize size;
  scenegraph::Color background{0.12F, 0.13F, 0.15F, 1.0F};
  scenegraph::PointWay points = scenegraph::PointWay::Auto;
};

/// Texts of the options above as typed; CLI11 fills them, view() parses them so that every error reads alike.
class ViewArguments {
 public:
  explicit ViewArguments(CLI::App& command);
  [[nodiscard]] Result<ViewOptions> view() const;

 private:
  CLI::App& command_;
  LayoutArguments layout_;
  ViewOptions options_;
  std::string time_ = "end";
  std::string fixed_frame_;
  std::vector<std::string> layers_;
  std::string eye_;
  std::string look_at_;
  std::string fov_ = "50";
  std::string camera_ = "orbit";
  std::string ortho_height_;
  std::string follow_;
  std::string size_ = "1280x720";
  std::string background_ = "#1f2126";
  std::string points_ = "auto";
};

/// "orbit", "xyorbit", "topdown" or "fly".
[[nodiscard]] Result<scenegraph::CameraKind> parseCamera(const std::string& text);
inline constexpr const char* kPointsHelp =
    "auto, gl (primitives), cpu (for OpenGL in software), or compute (shaders, for a GPU)";
/// "auto", "gl", "cpu" or "compute".
[[nodiscard]] Result<scenegraph::PointWay> parsePointWay(const std::string& text);
/// "FRAME" (rigidly: pose) or "FRAME:MODE", MODE being position, heading or pose. A frame's own name may hold colons.
[[nodiscard]] Result<std::pair<std::string, scenegraph::FollowMode>> parseFollow(const std::string& text);

}  // namespace stillframe::cli
