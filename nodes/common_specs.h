#pragma once

#include <string>

#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// Settings that many layers have, under one key and one name.

/// "opacity", 0 to 1.
[[nodiscard]] scenegraph::SettingSpec opacitySpec(const std::string& help = "1 hides what is behind.");
/// "flat_color": of what is not coloured by value.
[[nodiscard]] scenegraph::SettingSpec flatColorSpec();
/// "missing_color": `help` says of what.
[[nodiscard]] scenegraph::SettingSpec missingColorSpec(const std::string& help);

}  // namespace stillframe::nodes
