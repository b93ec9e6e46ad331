#pragma once

#include <string>
#include <vector>

#include "scenegraph/settings.h"

namespace stillframe::viewer {

/// A layer named by the user, with settings.
struct LayerChoice {
  std::string id;  ///< see scenegraph::LayerSlot
  scenegraph::SettingTexts settings;
};

/// Which layers a new view has.
struct LayerChoices {
  std::vector<LayerChoice> layers = {};
  bool only = false;  ///< no others than those
};

}  // namespace stillframe::viewer
