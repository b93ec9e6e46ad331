#pragma once

#include <map>
#include <string>
#include <vector>

#include "scenegraph/passes/view_effects.h"
#include "tools/cli/cli_error.h"

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11 has it so
class App;
}

namespace stillframe::cli {

/// The effects of a picture as options: `--ssao`, `--edl`, `--dither`, `--tonemap CURVE`, `--exposure EV`, `--aa MODE`,
/// each followed by `:key=value,...` for its settings where it has some.
class EffectArguments {
 public:
  explicit EffectArguments(CLI::App& command);
  /// `effects` with what the command line says of them.
  [[nodiscard]] Result<scenegraph::ViewEffects> effects(scenegraph::ViewEffects effects = {}) const;

  /// The words of a command line with `--ssao:radius=1` written as CLI11 reads it.
  [[nodiscard]] static std::vector<std::string> spelledOut(const std::vector<std::string>& words);

 private:
  std::map<std::string, std::string> flags_;  // by effect, as typed; "" where it was not
  std::string tonemap_;
  std::string exposure_;
  std::string aa_;
};

}  // namespace stillframe::cli
