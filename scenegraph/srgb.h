#pragma once

#include <cmath>
#include <glm/vec3.hpp>

namespace stillframe::scenegraph {

/// Light of an sRGB-encoded component (IEC 61966-2-1), as sfLinearFromSrgb() of common.glsl has it.
[[nodiscard]] inline float linearFromSrgb(float srgb) noexcept {
  return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F);
}

[[nodiscard]] inline glm::vec3 linearFromSrgb(const glm::vec3& srgb) noexcept {
  return {linearFromSrgb(srgb.r), linearFromSrgb(srgb.g), linearFromSrgb(srgb.b)};
}

}  // namespace stillframe::scenegraph
