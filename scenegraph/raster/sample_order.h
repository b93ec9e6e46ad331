#pragma once

#include <cstddef>
#include <cstdint>

namespace stillframe::scenegraph {

/// The order in which the points of a cloud are drawn when not all of them can be.
///
/// A cloud is cut into groups of 1024 points, neighbours in the message. Pass p takes one point of each group, a
/// different one each time, and after 1024 passes every point has been taken once. So every prefix of passes is a
/// stratified sample of the cloud: no group has given more than any other, each half (quarter, ...) of a group as much
/// as the other, and where in it is random: van der Corput's sequence with Owen's nested scrambling by the number of
/// the group (Owen 1995; by the hash of Laine and Karras, "Stratified sampling for stochastic transparency", 2011). It
/// beats against neither the rings of a lidar nor the rows of a camera, needs no memory and no reordering, and reads
/// memory forwards.
inline constexpr std::uint32_t kPassesOfSample = 1024;

/// Place of the point within group `group` that pass `pass` (below kPassesOfSample) takes: a bijection for each group.
[[nodiscard]] constexpr std::uint32_t placeInGroup(std::uint32_t group, std::uint32_t pass) noexcept {
  // The finaliser of MurmurHash3 (Appleby), an avalanche of the group's number.
  std::uint32_t seed = group;
  seed = (seed ^ (seed >> 16U)) * 0x85ebca6bU;
  seed = (seed ^ (seed >> 13U)) * 0xc2b2ae35U;
  seed ^= seed >> 16U;
  // Each step changes a bit by the bits below it only, so that what is left of it, 10 bits, is a bijection.
  std::uint32_t scrambled = pass + seed;
  scrambled ^= scrambled * 0x6c50b47cU;
  scrambled ^= scrambled * 0xb82f1e52U;
  scrambled ^= scrambled * 0xc7afe638U;
  scrambled ^= scrambled * 0x8d22f6e6U;
  // The low 16 bits reversed, of which the upper 10 are those asked for.
  scrambled = ((scrambled & 0x5555U) << 1U) | ((scrambled >> 1U) & 0x5555U);
  scrambled = ((scrambled & 0x3333U) << 2U) | ((scrambled >> 2U) & 0x3333U);
  scrambled = ((scrambled & 0x0f0fU) << 4U) | ((scrambled >> 4U) & 0x0f0fU);
  scrambled = ((scrambled & 0x00ffU) << 8U) | ((scrambled >> 8U) & 0x00ffU);
  return scrambled >> 6U;
}

/// The passes are gone through twice. What a group gives in the first lap ends after its own `most` passes, a power of
/// two: where it covers few pixels, more of its points than that fall on one another, and the time goes to groups that
/// are seen larger. The second lap takes what is left of every group, so that in the end each point has been taken
/// once.
inline constexpr std::uint32_t kPassesOfBothLaps = 2 * kPassesOfSample;

/// A run of passes of both laps, first to last; the whole cloud by default.
struct PassRange {
  std::uint32_t first = 0;
  std::uint32_t end = kPassesOfBothLaps;

  [[nodiscard]] constexpr bool isWhole() const noexcept { return first == 0 && end == kPassesOfBothLaps; }
  friend constexpr bool operator==(const PassRange&, const PassRange&) = default;
};

/// The passes below kPassesOfSample that a run takes of one group: those of the first lap, and those of the second.
struct GroupTurns {
  PassRange first_lap{0, 0};
  PassRange second_lap{0, 0};

  [[nodiscard]] constexpr std::uint32_t count() const noexcept {
    return first_lap.end - first_lap.first + second_lap.end - second_lap.first;
  }
};

[[nodiscard]] constexpr GroupTurns turnsOf(const PassRange& run, std::uint32_t most) noexcept {
  const auto within = [](std::uint32_t pass, std::uint32_t low, std::uint32_t high) {
    return pass < low ? low : pass > high ? high : pass;
  };
  constexpr std::uint32_t kLap = kPassesOfSample;
  return {{within(run.first, 0, most), within(run.end, 0, most)},
          {within(run.first, kLap + most, 2 * kLap) - kLap, within(run.end, kLap + most, 2 * kLap) - kLap}};
}

}  // namespace stillframe::scenegraph
