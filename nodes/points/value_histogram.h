#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "scenegraph/color_legend.h"

namespace stillframe::nodes {

inline constexpr std::size_t kHistogramBins = 64;

/// Of values + offset, without those that stand for NaN and infinities. No counts without values; all in one bin when
/// they are equal. Two passes. Any thread.
[[nodiscard]] scenegraph::ValueHistogram histogramOf(std::span<const float> values, double offset);
/// Of dot(direction, p) + offset over packed x y z positions.
[[nodiscard]] scenegraph::ValueHistogram histogramAlong(std::span<const float> positions, const glm::dvec3& direction,
                                                        double offset);

}  // namespace stillframe::nodes
