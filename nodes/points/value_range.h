#pragma once

#include <span>

namespace stillframe::nodes {

/// Values that get the ends of the colormap; low > high runs it backwards.
struct ValueRange {
  double low = 0.0;
  double high = 1.0;

  friend bool operator==(const ValueRange&, const ValueRange&) = default;
};

/// Nearest-rank percentiles of the values that are neither kMissingValue nor beyond kValueReach, plus `offset`; in
/// percent, clamped to 0..100 and sorted. {0, 0} without such values. O(n), copies the values.
[[nodiscard]] ValueRange percentileRange(std::span<const float> values, double offset, double low_percent,
                                         double high_percent);
/// The same of one axis of packed x y z positions.
[[nodiscard]] ValueRange percentileRangeOfAxis(std::span<const float> positions, int axis, double offset,
                                               double low_percent, double high_percent);

/// t = value * scale + bias, 0 at low and 1 at high.
///
/// Always finite: a range without width, or with a limit that is not finite, puts every value at 0.5; a width that
/// overflows a double is halved on the way.
struct RangeMap {
  double scale = 0.0;
  double bias = 0.5;
};
[[nodiscard]] RangeMap mapRange(const ValueRange& range) noexcept;
/// The same for a value that was stored less `offset`: t = (value - offset) * scale + bias.
[[nodiscard]] RangeMap mapRange(const ValueRange& range, double offset) noexcept;

}  // namespace stillframe::nodes
