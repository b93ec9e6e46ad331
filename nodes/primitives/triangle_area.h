#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace stillframe::nodes {

/// Whether a triangle covers anything: its corners are finite and do not lie on one line, to a millionth of its longest
/// side. What fails it shows no pixel from anywhere. Any thread.
[[nodiscard]] inline bool hasArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) noexcept {
  const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
  constexpr double kFlat = 1e-6;
  // Of unit size first: squares of what is tiny or huge would leave the range of a double.
  return longest > 0.0 && glm::length(glm::cross((b - a) / longest, (c - a) / longest)) > kFlat;
}

}  // namespace stillframe::nodes
