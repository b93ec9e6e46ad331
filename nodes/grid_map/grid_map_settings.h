#pragma once

#include <string>

#include "nodes/coloring.h"
#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// How a grid map is drawn.
struct GridMapSettings : ValueColoring {
  std::string height_field = "auto";
  bool flat = false;
  std::string color_field = "auto";
  bool shading = true;
  double opacity = 1.0;
  scenegraph::Color flat_color{.r = 217 / 255.0F, .g = 222 / 255.0F, .b = 230 / 255.0F, .a = 1.0F};
  scenegraph::Color missing_color{.r = 115 / 255.0F, .g = 115 / 255.0F, .b = 115 / 255.0F, .a = 1.0F};

  friend bool operator==(const GridMapSettings&, const GridMapSettings&) = default;
};

[[nodiscard]] const scenegraph::SettingsTable<GridMapSettings>& gridMapSettingsTable();

}  // namespace stillframe::nodes
