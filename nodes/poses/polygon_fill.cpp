#include "nodes/poses/polygon_fill.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace stillframe::nodes {
namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The outline on the plane that it spans best, scaled to about 1, counter-clockwise; empty without area.
std::vector<glm::dvec2> flatten(std::span<const glm::dvec3> corners) {
  glm::dvec3 low = corners.front();
  glm::dvec3 high = corners.front();
  for (const glm::dvec3& corner : corners) {
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  const glm::dvec3 size = high - low;
  const double scale = std::max({size.x, size.y, size.z});
  if (!(scale > 0.0) || !std::isfinite(scale)) {
    return {};
  }
  std::vector<glm::dvec3> local;
  local.reserve(corners.size());
  for (const glm::dvec3& corner : corners) {
    local.push_back((corner - low) / scale);
  }
  glm::dvec3 normal(0.0);  // Newell's: twice the areas seen along the three axes
  for (std::size_t i = 0; i < local.size(); ++i) {
    normal += glm::cross(local[i], local[(i + 1) % local.size()]);
  }
  const double area = glm::length(normal);
  if (!(area > 1e-15)) {
    return {};
  }
  normal /= area;
  const glm::dvec3 other = std::abs(normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(other, normal));
  const glm::dvec3 y = glm::cross(normal, x);
  std::vector<glm::dvec2> flat;
  flat.reserve(local.size());
  for (const glm::dvec3& corner : local) {
    flat.emplace_back(glm::dot(corner, x), glm::dot(corner, y));
  }
  return flat;
}

}  // namespace

std::optional<std::vector<std::uint32_t>> fillPolygon(std::span<const glm::dvec3> corners) {
  if (corners.size() > kMostFilledCorners) {
    return std::nullopt;
  }
  std::vector<std::uint32_t> triangles;
  const std::vector<glm::dvec2> flat = corners.size() < 3 ? std::vector<glm::dvec2>() : flatten(corners);
  if (flat.empty()) {
    return triangles;
  }
  std::vector<std::uint32_t> left(flat.size());
  for (std::uint32_t i = 0; i < left.size(); ++i) {
    left[i] = i;
  }
  const auto isEar = [&](std::size_t at) {
    const std::size_t count = left.size();
    const std::uint32_t before = left[(at + count - 1) % count];
    const std::uint32_t here = left[at];
    const std::uint32_t after = left[(at + 1) % count];
    if (cross(flat[before], flat[here], flat[after]) <= 0.0) {
      return false;
    }
    return std::ranges::none_of(left, [&](std::uint32_t other) {
      const glm::dvec2& p = flat[other];
      return p != flat[before] && p != flat[here] && p != flat[after] && cross(flat[before], flat[here], p) >= 0.0 &&
             cross(flat[here], flat[after], p) >= 0.0 && cross(flat[after], flat[before], p) >= 0.0;
    });
  };
  std::size_t at = 0;
  std::size_t refused = 0;
  while (left.size() > 3) {
    at %= left.size();
    const std::size_t count = left.size();
    const std::uint32_t before = left[(at + count - 1) % count];
    const std::uint32_t after = left[(at + 1) % count];
    const double turn = cross(flat[before], flat[left[at]], flat[after]);
    const bool is_ear = isEar(at);
    // Crossed outlines run out of ears: then any corner that turns the right way goes, and at last any at all.
    if (is_ear || turn == 0.0 || (refused > count && turn > 0.0) || refused > 2 * count) {
      if (turn > 0.0) {
        triangles.insert(triangles.end(), {before, left[at], after});
      }
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
      at = at == 0 ? left.size() - 1 : at - 1;
      refused = 0;
    } else {
      ++at;
      ++refused;
    }
  }
  if (cross(flat[left[0]], flat[left[1]], flat[left[2]]) > 0.0) {
    triangles.insert(triangles.end(), {left[0], left[1], left[2]});
  }
  return triangles;
}

}  // namespace stillframe::nodes
