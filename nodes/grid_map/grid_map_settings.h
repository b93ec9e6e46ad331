#pragma once

#include <string>

#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// How a grid map is drawn.
struct GridMapSettings {
  std::string height_field = "auto";
  bool flat = false;
  std::string color_field = "auto";
  std::string colormap = "turbo";
  bool reverse_colormap = false;
  std::string range_mode = "auto";
  double range_min = 0.0;
  double range_max = 1.0;
  double percentile_low = 1.0;
  double percentile_high = 99.0;
  bool shading = true;
  double opacity = 1.0;
  scenegraph::Color flat_color{.r = 217 / 255.0F, .g = 222 / 255.0F, .b = 230 / 255.0F, .a = 1.0F};
  scenegraph::Color missing_color{.r = 115 / 255.0F, .g = 115 / 255.0F, .b = 115 / 255.0F, .a = 1.0F};

  friend bool operator==(const GridMapSettings&, const GridMapSettings&) = default;
};

[[nodiscard]] const scenegraph::SettingsTable<GridMapSettings>& gridMapSettingsTable();

}  // namespace stillframe::nodes
