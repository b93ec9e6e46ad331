#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace stillframe::tf {

/// Where `stamp` would lie in ascending `stamps` if they were evenly spaced between `first` and `last`; in [0, count).
/// Needs first <= stamp < last.
[[nodiscard]] inline std::size_t interpolatedIndex(std::int64_t first, std::int64_t last, std::size_t count,
                                                   std::int64_t stamp) noexcept {
  // Differences of int64 need uint64; halved, they fit a signed integer, which converts to double in one instruction.
  const auto before =
      static_cast<std::int64_t>((static_cast<std::uint64_t>(stamp) - static_cast<std::uint64_t>(first)) >> 1);
  const auto whole =
      static_cast<std::int64_t>((static_cast<std::uint64_t>(last) - static_cast<std::uint64_t>(first)) >> 1);
  const double fraction = static_cast<double>(before) / (static_cast<double>(whole) + 1.0);
  const auto index = static_cast<std::size_t>(static_cast<std::int64_t>(fraction * static_cast<double>(count)));
  return index < count ? index : count - 1;
}

/// Stamps that one look around a guess compares, without a branch to mispredict.
inline constexpr std::size_t kStampWindow = 8;

/// Number of `stamps` at or before `stamp` if that lies within a window around `guess`; stamps.size() + 1 if not. Needs
/// at least kStampWindow stamps and guess < stamps.size().
[[nodiscard]] inline std::size_t countNearGuess(std::span<const std::int64_t> stamps, std::int64_t stamp,
                                                std::size_t guess) noexcept {
  constexpr std::size_t kBefore = kStampWindow / 2;
  const std::size_t start = std::min(guess < kBefore ? 0 : guess - kBefore, stamps.size() - kStampWindow);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < kStampWindow; ++i) {
    inside += stamps[start + i] <= stamp ? 1 : 0;
  }
  const bool low_end_known = inside > 0 || start == 0;
  const bool high_end_known = inside < kStampWindow || start + kStampWindow == stamps.size();
  return low_end_known && high_end_known ? start + inside : stamps.size() + 1;
}

/// Number of `stamps` (strictly ascending) at or before `stamp`.
///
/// Looks where evenly spaced stamps would have it and gallops from there: one look for a steady rate, whatever the
/// length; O(log n) for any spacing.
[[nodiscard]] inline std::size_t countAtOrBefore(std::span<const std::int64_t> stamps, std::int64_t stamp) noexcept {
  const std::size_t count = stamps.size();
  if (count < kStampWindow) {
    std::size_t result = 0;
    for (const std::int64_t each : stamps) {
      result += each <= stamp ? 1 : 0;
    }
    return result;
  }
  if (stamp < stamps.front()) {
    return 0;
  }
  if (stamp >= stamps.back()) {
    return count;
  }
  const std::size_t guess = interpolatedIndex(stamps.front(), stamps.back(), count - 1, stamp);
  if (const std::size_t near = countNearGuess(stamps, stamp, guess); near <= count) {
    return near;
  }
  // Invariant from here: stamps[low] <= stamp < stamps[high].
  std::size_t low = 0;
  std::size_t high = count - 1;
  if (stamps[guess] <= stamp) {
    low = guess;
    for (std::size_t step = 1; low + step < high; step *= 2) {
      if (stamps[low + step] > stamp) {
        high = low + step;
        break;
      }
      low += step;
    }
  } else {
    high = guess;
    for (std::size_t step = 1; step < high; step *= 2) {
      if (stamps[high - step] <= stamp) {
        low = high - step;
        break;
      }
      high -= step;
    }
  }
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (stamps[middle] <= stamp ? low : high) = middle;
  }
  return low + 1;
}

}  // namespace stillframe::tf
