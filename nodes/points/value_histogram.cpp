#include "nodes/points/value_histogram.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nodes/points/channel.h"

namespace stillframe::nodes {
namespace {

/// `at(i)` is the value, NaN for none.
template <typename At>
scenegraph::ValueHistogram count(std::size_t values, double offset, const At& at) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < values; ++i) {
    const double value = at(i);
    low = value < low ? value : low;  // false for NaN
    high = value > high ? value : high;
  }
  if (!(low <= high)) {
    return {};
  }
  scenegraph::ValueHistogram histogram{low + offset, high + offset, std::vector<std::uint64_t>(kHistogramBins)};
  const double width = high - low;
  const double bins_per_unit = width > 0.0 ? static_cast<double>(kHistogramBins) / width : 0.0;
  // A width too small or too large for its inverse: all in the first bin.
  const double scale = std::isfinite(bins_per_unit) ? bins_per_unit : 0.0;
  for (std::size_t i = 0; i < values; ++i) {
    if (const double value = at(i); !std::isnan(value)) {
      ++histogram.counts[std::min(kHistogramBins - 1, static_cast<std::size_t>((value - low) * scale))];
    }
  }
  return histogram;
}

}  // namespace

scenegraph::ValueHistogram histogramOf(std::span<const float> values, double offset) {
  return count(values.size(), offset, [&](std::size_t i) {
    return std::abs(values[i]) < kValueReach ? static_cast<double>(values[i])
                                             : std::numeric_limits<double>::quiet_NaN();
  });
}

scenegraph::ValueHistogram histogramAlong(std::span<const float> positions, const glm::dvec3& direction,
                                          double offset) {
  return count(positions.size() / 3, offset, [&](std::size_t i) {
    return direction.x * positions[3 * i] + direction.y * positions[3 * i + 1] + direction.z * positions[3 * i + 2];
  });
}

}  // namespace stillframe::nodes
