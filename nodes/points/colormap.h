#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace stillframe::nodes {

/// sRGB-encoded components 0..1.
using SrgbColor = std::array<float, 3>;

/// A map from 0..1 to colour as equally spaced anchors with straight lines between them: small enough for a uniform
/// array, so that another colormap is another uniform and never another vertex or texture.
///
/// Anchors are samples of the published tables: turbo (A. Mikhailov, 2019), viridis, plasma, inferno, magma (S. van der
/// Walt and N. Smith, 2015, CC0), cividis (J. Nunez et al., 2018), coolwarm (K. Moreland, 2009). Against the full
/// 256-entry tables the lines are off by at most 1.9, 1.8, 3.1, 1.5, 1.3, 5.7 and 0.6 steps of 8 bits. Grayscale and
/// jet are exact by their definition.
struct Colormap {
  static constexpr std::size_t kAnchors = 33;
  std::string_view name;
  std::array<SrgbColor, kAnchors> anchors;

  /// Colour at t, clamped to 0..1; NaN is the first anchor. What the shaders compute.
  [[nodiscard]] SrgbColor at(double t) const noexcept;
};

/// Every colormap, the default first.
[[nodiscard]] std::span<const Colormap> colormaps();
/// By name; nullptr when there is none of that name.
[[nodiscard]] const Colormap* findColormap(std::string_view name);

}  // namespace stillframe::nodes
