#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scenegraph/color_legend.h"
#include "scenegraph/scene.h"

namespace stillframe::nodes {

/// The legend of a layer, under the layer's name.
struct LegendEntry {
  std::string layer;
  scenegraph::ColorLegend legend;

  friend bool operator==(const LegendEntry&, const LegendEntry&) = default;
};

/// Of the visible layers that colour by value and are to have a legend, in their order.
[[nodiscard]] std::vector<LegendEntry> legendEntries(const scenegraph::Scene& scene);

/// 8 bits a component, sRGB-encoded, straight alpha, top row first.
struct LegendPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;

  [[nodiscard]] bool isEmpty() const noexcept { return rgba.empty(); }
};

/// Legends one below the other on a dark, translucent card: name, values with their unit, the colours from low to high
/// and the values at both ends and in the middle. As many as `most_px` of height have room for; the last line says how
/// many there are besides. Empty without entries, or where there is no room for one. `scale` is pixels per unit of its
/// design, 1 on an ordinary display. GUI thread (fonts are OSG's); about a millisecond.
[[nodiscard]] LegendPicture drawLegends(std::span<const LegendEntry> entries, double scale, int most_px);

/// The legends of a picture of that size: they shrink with it to a third of its width, to three quarters of their size
/// at the least, and take 40 % of its height and a sixth of its area at most. Empty where it is too narrow for any.
[[nodiscard]] LegendPicture drawFittingLegends(std::span<const LegendEntry> entries, double scale, int width_px,
                                               int height_px);

/// "12.5", "1.234e+07": as many digits as tell values apart that lie a hundredth of the range from each other.
[[nodiscard]] std::string legendNumber(double value, double low, double high);

}  // namespace stillframe::nodes
