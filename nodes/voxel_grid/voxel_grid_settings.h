#pragma once

#include <cstdint>
#include <string>

#include "nodes/coloring.h"
#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// Which voxels are drawn, and how. None of it changes a buffer, but for another field.
struct VoxelGridSettings : ValueColoring {
  std::string draw_field = "auto";
  std::string draw_if = "above";
  double draw_from = 0.0;
  double draw_to = 1.0;
  std::int64_t draw_bits = 1;
  std::string color_field = "auto";
  bool shading = true;
  double opacity = 1.0;
  scenegraph::Color flat_color{.r = 217 / 255.0F, .g = 222 / 255.0F, .b = 230 / 255.0F, .a = 1.0F};
  scenegraph::Color missing_color{.r = 115 / 255.0F, .g = 115 / 255.0F, .b = 115 / 255.0F, .a = 1.0F};

  friend bool operator==(const VoxelGridSettings&, const VoxelGridSettings&) = default;
};

[[nodiscard]] const scenegraph::SettingsTable<VoxelGridSettings>& voxelGridSettingsTable();

}  // namespace stillframe::nodes
