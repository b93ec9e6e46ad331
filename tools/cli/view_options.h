#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli/cli_error.h"
#include "tools/cli/layer_argument.h"
#include "tools/cli/recording_options.h"
#include "tools/cli/time_argument.h"
#include "tools/cli/value_arguments.h"

namespace stillframe::cli {

/// What `render`, `export` and the osgDB plugin are asked to show.
struct ViewOptions {
  RecordingOptions recording;
  TimeArgument time;
  std::optional<std::string> fixed_frame;
  std::vector<LayerArgument> layers;
  bool only_named_layers = false;
  std::optional<glm::dvec3> eye;      ///< in the fixed frame
  std::optional<glm::dvec3> look_at;  ///< in the fixed frame
  double vertical_fov_deg = 50.0;
  PictureSize size;
  scenegraph::Color background{0.12F, 0.13F, 0.15F, 1.0F};
};

/// Texts of the options above as typed; CLI11 fills them, view() parses them so that every error reads alike.
class ViewArguments {
 public:
  explicit ViewArguments(CLI::App& command);
  [[nodiscard]] Result<ViewOptions> view() const;

 private:
  ViewOptions options_;
  std::string time_ = "end";
  std::string fixed_frame_;
  std::vector<std::string> layers_;
  std::string eye_;
  std::string look_at_;
  std::string fov_ = "50";
  std::string size_ = "1280x720";
  std::string background_ = "#1f2126";
};

}  // namespace stillframe::cli
