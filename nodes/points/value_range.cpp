#include "nodes/points/value_range.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "nodes/points/channel.h"

namespace stillframe::nodes {
namespace {

ValueRange percentiles(std::vector<float> values, double offset, double low_percent, double high_percent) {
  if (values.empty()) {
    return {0.0, 0.0};
  }
  const auto at = [&](double percent) {
    const double fraction = std::isfinite(percent) ? std::clamp(percent, 0.0, 100.0) / 100.0 : 0.0;
    const auto rank = static_cast<std::ptrdiff_t>(std::llround(fraction * static_cast<double>(values.size() - 1)));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return static_cast<double>(values[static_cast<std::size_t>(rank)]) + offset;
  };
  const double a = at(low_percent);
  const double b = at(high_percent);
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

ValueRange percentileRange(std::span<const float> values, double offset, double low_percent, double high_percent) {
  std::vector<float> kept;
  kept.reserve(values.size());
  std::ranges::copy_if(values, std::back_inserter(kept), [](float v) { return std::abs(v) < kValueReach; });
  return percentiles(std::move(kept), offset, low_percent, high_percent);
}

ValueRange percentileRangeOfAxis(std::span<const float> positions, int axis, double offset, double low_percent,
                                 double high_percent) {
  std::vector<float> values;
  values.reserve(positions.size() / 3);
  for (std::size_t i = static_cast<std::size_t>(axis); i < positions.size(); i += 3) {
    values.push_back(positions[i]);
  }
  return percentiles(std::move(values), offset, low_percent, high_percent);
}

RangeMap mapRange(const ValueRange& range) noexcept { return mapRange(range, 0.0); }

RangeMap mapRange(const ValueRange& range, double offset) noexcept {
  constexpr double kLargest = std::numeric_limits<float>::max();  // uniforms are float
  const double half_width = range.high / 2 - range.low / 2;
  if (!std::isfinite(half_width) || half_width == 0.0) {
    return {};
  }
  const double scale = 0.5 / half_width;
  const double bias = (offset / 2 - range.low / 2) / half_width;
  if (!std::isfinite(scale) || !std::isfinite(bias) || std::abs(scale) > kLargest || std::abs(bias) > kLargest) {
    return {};
  }
  return {scale, bias};
}

}  // namespace stillframe::nodes
