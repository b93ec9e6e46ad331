#pragma once

#include <string>
#include <string_view>

#include "scenegraph/settings.h"
#include "tools/cli/cli_error.h"

namespace stillframe::cli {

/// `--layer TOPIC[:key=value,...]`.
struct LayerArgument {
  std::string id;  ///< a topic, a built-in ("tf", "grid"), or a duplicate of one ("TOPIC#2")
  scenegraph::SettingTexts settings;
};

/// The settings begin at the first ':' that a `key=` follows, so that topics may hold colons. A value with a comma in
/// it is quoted: 'a,b' or "a,b"; within double quotes a backslash takes the next character as it is.
[[nodiscard]] Result<LayerArgument> parseLayer(std::string_view text);

/// "key=value,...", quoted as above. `what` names it in the error.
[[nodiscard]] Result<scenegraph::SettingTexts> parseSettings(const std::string& what, std::string_view text);

}  // namespace stillframe::cli
