#pragma once

#include <cstdint>
#include <string>

#include "nodes/coloring.h"
#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// How poses, paths, points and polygons are drawn.
struct PosesSettings : ValueColoring {
  std::string shape = "auto";
  double length_m = 0.3;
  bool override_color = false;
  scenegraph::Color arm_color{.r = 1.0F, .g = 25 / 255.0F, .b = 0.0F, .a = 1.0F};
  double radius_m = 0.1;
  double opacity = 1.0;
  std::int64_t max_shapes = 100'000;
  bool child_label = false;

  std::string line = "auto";
  double line_width = 2.0;
  std::string line_unit = "px";
  std::string color_field = "flat";
  scenegraph::Color color{.r = 70 / 255.0F, .g = 210 / 255.0F, .b = 90 / 255.0F, .a = 1.0F};
  scenegraph::Color missing_color{.r = 115 / 255.0F, .g = 115 / 255.0F, .b = 115 / 255.0F, .a = 1.0F};
  bool fill = false;
  double fill_opacity = 0.3;

  std::string trail = "none";
  std::int64_t trail_poses = 100;
  double trail_seconds = 10.0;
  bool trail_shapes = false;

  bool covariance = true;
  bool orientation_cone = true;
  double sigma = 1.0;
  scenegraph::Color covariance_color{.r = 204 / 255.0F, .g = 51 / 255.0F, .b = 204 / 255.0F, .a = 77 / 255.0F};
  scenegraph::Color cone_color{.r = 1.0F, .g = 1.0F, .b = 127 / 255.0F, .a = 102 / 255.0F};

  friend bool operator==(const PosesSettings&, const PosesSettings&) = default;
};

[[nodiscard]] const scenegraph::SettingsTable<PosesSettings>& posesSettingsTable();

}  // namespace stillframe::nodes
