#include "tools/cli/layout_argument.h"

#include <CLI/CLI.hpp>

namespace stillframe::cli {

LayoutArguments::LayoutArguments(CLI::App& command) {
  CLI::Option* const file = command.add_option(
      "--layout", file_, "A saved layout (.xml): frames, camera, effects and layers; other options go before it");
  file->type_name("FILE");
  command.add_option("--layout-view", number_, "Which view of the layout, from 1")->capture_default_str()->needs(file);
}

Result<std::optional<scenegraph::ViewLayout>> LayoutArguments::view() const {
  if (file_.empty()) {
    return std::nullopt;
  }
  const auto layout = readLayoutFile(file_);
  if (!layout) {
    return std::unexpected(layout.error());
  }
  const auto views = scenegraph::viewsOf(*layout);
  if (number_ < 1 || static_cast<std::size_t>(number_) > views.size()) {
    return usageError("--layout-view " + std::to_string(number_) + ": " + file_ + " has views 1 to " +
                      std::to_string(views.size()));
  }
  return *views[static_cast<std::size_t>(number_) - 1];
}

Result<scenegraph::Layout> readLayoutFile(const std::string& file) {
  auto layout = scenegraph::readLayout(file);
  return layout ? Result<scenegraph::Layout>(std::move(*layout)) : failure(layout.error().message);
}

scenegraph::ViewEffects effectsOf(const std::optional<scenegraph::ViewLayout>& layout) {
  scenegraph::ViewEffects effects;
  if (layout) {
    (void)effects.fromTexts(layout->effects);  // SceneSession tells what was refused
  }
  return effects;
}

}  // namespace stillframe::cli
