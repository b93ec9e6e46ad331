#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/cli/view_options.h"

namespace stillframe::osgplugin {

/// What an osgDB option string asks for.
struct PluginOptions {
  cli::ViewOptions view;
  std::vector<std::string> unknown;  ///< words that mean nothing here; they may be meant for another plugin
};

/// Words separated by spaces, each key=value, a value with spaces in double quotes:
///
/// - `time=` as on the command line (default: end), `fixed_frame=`, `tf_time=auto|header|log`, `static_always`;
/// - `layout=FILE`: frames and layers of the first view of a saved layout;
/// - `layers=LAYER;LAYER`: just these, each TOPIC[:key=value,...];
/// - `layer=LAYER`: that one with these settings, beside all others; may be repeated;
/// - `height=PIXELS`: of the window, for points whose size is in metres.
[[nodiscard]] cli::Result<PluginOptions> parseOptionString(std::string_view text);

}  // namespace stillframe::osgplugin
