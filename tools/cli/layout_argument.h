#pragma once

#include <optional>
#include <string>

#include "scenegraph/layout/window_layout.h"
#include "scenegraph/passes/view_effects.h"
#include "tools/cli/cli_error.h"

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11 has it so
class App;
}

namespace stillframe::cli {

/// `--layout FILE` with `--layout-view N`: one view of a saved arrangement, or of a host's own layout.
class LayoutArguments {
 public:
  explicit LayoutArguments(CLI::App& command);
  /// nullopt without --layout.
  [[nodiscard]] Result<std::optional<scenegraph::ViewLayout>> view() const;

 private:
  std::string file_;
  int number_ = 1;
};

/// The layout in `file`; a failure names it in one line.
[[nodiscard]] Result<scenegraph::Layout> readLayoutFile(const std::string& file);

/// The effects of a saved view, without what is refused there.
[[nodiscard]] scenegraph::ViewEffects effectsOf(const std::optional<scenegraph::ViewLayout>& layout);

}  // namespace stillframe::cli
