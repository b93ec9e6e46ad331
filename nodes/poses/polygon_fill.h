#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace stillframe::nodes {

/// Outlines longer than this are not filled: ear clipping costs the square of their length, or more.
inline constexpr std::size_t kMostFilledCorners = 1000;

/// Triangles, as indices of `corners`, that fill an outline of which the last corner is joined to the first, seen along
/// its mean normal; concave outlines come out right, ones that cross themselves come out as something. Every triangle
/// has the turn of the outline. Empty for fewer than three corners, or without area; nullopt beyond kMostFilledCorners.
/// Corners are finite.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> fillPolygon(std::span<const glm::dvec3> corners);

}  // namespace stillframe::nodes
