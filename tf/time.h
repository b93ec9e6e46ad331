#pragma once

#include <compare>
#include <cstdint>

namespace stillframe::tf {

/// An instant: int64 nanoseconds since the Unix epoch (or since zero, for a simulation's clock).
///
/// The whole int64 range is valid; arithmetic on it is the caller's business, because a difference of two instants may
/// not fit an int64. Use secondsBetween() where a double is enough.
struct TimePoint {
  std::int64_t ns = 0;

  friend constexpr auto operator<=>(const TimePoint&, const TimePoint&) = default;
};

/// `later - earlier` in seconds, without overflow at the ends of int64.
[[nodiscard]] constexpr double secondsBetween(TimePoint earlier, TimePoint later) noexcept {
  return later >= earlier
             ? static_cast<double>(static_cast<std::uint64_t>(later.ns) - static_cast<std::uint64_t>(earlier.ns)) * 1e-9
             : -static_cast<double>(static_cast<std::uint64_t>(earlier.ns) - static_cast<std::uint64_t>(later.ns)) *
                   1e-9;
}

/// Nanoseconds written with their unit: `TimePoint{10_s + 5_ms}`.
inline namespace literals {
constexpr std::int64_t operator""_ns(unsigned long long value) { return static_cast<std::int64_t>(value); }
constexpr std::int64_t operator""_us(unsigned long long value) { return static_cast<std::int64_t>(value) * 1'000; }
constexpr std::int64_t operator""_ms(unsigned long long value) { return static_cast<std::int64_t>(value) * 1'000'000; }
constexpr std::int64_t operator""_s(unsigned long long value) {
  return static_cast<std::int64_t>(value) * 1'000'000'000;
}
}  // namespace literals

}  // namespace stillframe::tf
