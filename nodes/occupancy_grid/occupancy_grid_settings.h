#pragma once

#include <string>

#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// How a grid is drawn. None of it changes a texture.
struct OccupancyGridSettings {
  std::string color_scheme = "map";
  double alpha = 1.0;
  bool draw_behind = false;
  bool has_legend = true;

  friend bool operator==(const OccupancyGridSettings&, const OccupancyGridSettings&) = default;
};

[[nodiscard]] const scenegraph::SettingsTable<OccupancyGridSettings>& occupancyGridSettingsTable();

}  // namespace stillframe::nodes
