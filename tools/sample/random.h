#pragma once

#include <cstdint>

namespace stillframe::sample {

/// Small seeded generator (SplitMix64) whose sequence is the same on every platform, unlike the std distributions.
class Random {
 public:
  explicit constexpr Random(std::uint64_t seed) noexcept : state_(seed) {}

  constexpr std::uint64_t bits() noexcept {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31U);
  }
  /// Uniform in [low, high).
  constexpr double uniform(double low, double high) noexcept {
    return low + (high - low) * static_cast<double>(bits() >> 11U) * 0x1.0p-53;
  }
  /// Mean 0, deviation 1, bounded by 3.47: the sum of four uniforms, enough for sensor noise and cheap.
  constexpr double gaussian() noexcept {
    const std::uint64_t word = bits();
    const double sum =
        static_cast<double>((word & 0xFFFFU) + ((word >> 16U) & 0xFFFFU) + ((word >> 32U) & 0xFFFFU) + (word >> 48U)) /
        65536.0;
    return (sum - 2.0) * 1.7320508075688772;
  }

 private:
  std::uint64_t state_;
};

}  // namespace stillframe::sample
