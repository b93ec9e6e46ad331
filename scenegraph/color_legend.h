#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace stillframe::scenegraph {

/// What the colours of a layer mean: values from low to high as these colours, evenly spaced.
struct ColorLegend {
  std::string title;  ///< of the values: "intensity", "z in map"
  std::string unit;   ///< "m", "s"; "" where the data does not say
  double low = 0.0;
  double high = 1.0;                              ///< below low where the colours run backwards
  std::vector<std::array<float, 3>> colors = {};  ///< sRGB-encoded, of low to high
  bool is_shown = true;                           ///< over the picture; the layer's own setting

  friend bool operator==(const ColorLegend&, const ColorLegend&) = default;
};

/// How often values occur, in equal steps from low to high; both ends are values that do.
struct ValueHistogram {
  double low = 0.0;
  double high = 0.0;
  std::vector<std::uint64_t> counts = {};
};

}  // namespace stillframe::scenegraph
