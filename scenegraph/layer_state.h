#pragma once

#include <set>
#include <string>
#include <vector>

#include "scenegraph/settings.h"

namespace stillframe::scenegraph {

/// A layer in plain values.
struct LayerState {
  std::string id;
  std::string title;  ///< "": the id
  bool is_visible = true;
  SettingTexts settings;

  friend bool operator==(const LayerState&, const LayerState&) = default;
};

/// The layers of a scene in plain values: what a layout keeps, a second view takes over, and undo goes back to.
struct LayerList {
  std::vector<LayerState> layers;        ///< in their order
  std::set<std::string> removed_topics;  ///< that do not come back by themselves

  friend bool operator==(const LayerList&, const LayerList&) = default;
};

}  // namespace stillframe::scenegraph
