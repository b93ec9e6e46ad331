#pragma once

#include <glm/vec3.hpp>
#include <string_view>

#include "scenegraph/settings.h"
#include "tools/cli/cli_error.h"

namespace stillframe::cli {

struct PictureSize {
  int width_px = 1280;
  int height_px = 720;
  friend bool operator==(const PictureSize&, const PictureSize&) = default;
};
inline constexpr int kMaxSide_px = 16384;

/// "x,y,z", three finite doubles. `what` names the option in the error.
[[nodiscard]] Result<glm::dvec3> parseVector(std::string_view what, std::string_view text);
/// "WxH", 1..kMaxSide_px each.
[[nodiscard]] Result<PictureSize> parseSize(std::string_view text);
/// "#rrggbb", "#rrggbbaa", "r,g,b" or "r,g,b,a" with components 0..1, or 0..255 when one of them is above 1;
/// "transparent" is 0,0,0,0. Alpha is 1 where it is not said.
[[nodiscard]] Result<scenegraph::Color> parseColor(std::string_view what, std::string_view text);
/// A finite double in [minimum, maximum].
[[nodiscard]] Result<double> parseNumber(std::string_view what, std::string_view text, double minimum, double maximum);

}  // namespace stillframe::cli
