#pragma once

#include <string>

#include "nodes/coloring.h"
#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// How a cloud is drawn. None of it changes a vertex.
struct PointCloudSettings : ValueColoring {
  std::string color_field = "auto";
  double point_size = 2.0;
  std::string size_unit = "px";
  bool round_points = false;
  double opacity = 1.0;
  scenegraph::Color flat_color{.r = 217 / 255.0F, .g = 222 / 255.0F, .b = 230 / 255.0F, .a = 1.0F};
  scenegraph::Color missing_color{.r = 115 / 255.0F, .g = 115 / 255.0F, .b = 115 / 255.0F, .a = 1.0F};

  friend bool operator==(const PointCloudSettings&, const PointCloudSettings&) = default;
};

/// Keys, ranges and help; the choices of color_field that every cloud has.
[[nodiscard]] const scenegraph::SettingsTable<PointCloudSettings>& pointCloudSettingsTable();

}  // namespace stillframe::nodes
