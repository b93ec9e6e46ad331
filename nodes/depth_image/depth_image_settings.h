#pragma once

#include <string>

#include "nodes/coloring.h"
#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// How a depth image is drawn. Only rectify and info_topic change the geometry.
struct DepthImageSettings : ValueColoring {
  DepthImageSettings() { range_max = 10.0; }

  std::string color_mode = "depth";
  double point_size = 2.0;
  scenegraph::Color flat_color{.r = 217 / 255.0F, .g = 222 / 255.0F, .b = 230 / 255.0F, .a = 1.0F};
  double max_depth_m = 0.0;
  bool rectify = true;
  std::string info_topic = "auto";
  std::string frame = "auto";

  friend bool operator==(const DepthImageSettings&, const DepthImageSettings&) = default;
};

[[nodiscard]] const scenegraph::SettingsTable<DepthImageSettings>& depthImageSettingsTable();

}  // namespace stillframe::nodes
