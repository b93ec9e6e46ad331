#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

namespace stillframe::scenegraph {

/// Light of an sRGB-encoded component (IEC 61966-2-1), as sfLinearFromSrgb() of common.glsl has it.
[[nodiscard]] inline float linearFromSrgb(float srgb) noexcept {
  return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F);
}

[[nodiscard]] inline glm::vec3 linearFromSrgb(const glm::vec3& srgb) noexcept {
  return {linearFromSrgb(srgb.r), linearFromSrgb(srgb.g), linearFromSrgb(srgb.b)};
}

/// The way back, exact; beyond [0, 1] is clamped, NaN is 0.
[[nodiscard]] inline double srgbFromLinear(float linear) noexcept {
  const double value = std::isnan(linear) ? 0.0 : std::clamp(static_cast<double>(linear), 0.0, 1.0);
  return value <= 0.0031308 ? value * 12.92 : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

/// The same, rounded to the nearest byte.
[[nodiscard]] inline std::uint8_t srgbByteFromLinear(float linear) noexcept {
  return static_cast<std::uint8_t>(std::lround(srgbFromLinear(linear) * 255.0));
}

}  // namespace stillframe::scenegraph
