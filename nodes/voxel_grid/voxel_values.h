#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "nodes/points/channel.h"
#include "nodes/points/packed_cells.h"

namespace stillframe::nodes {

/// How the values of a field lie in 32-bit words, as the shader reads them: integers of 8 and 16 bits side by side, the
/// least significant first; wider ones and floats a word each, a Float64 as float less the offset of its channel.
struct VoxelFormat {
  enum class Kind : std::uint8_t { Float = 0, Signed = 1, Unsigned = 2 };  ///< the numbers are the shader's
  Kind kind = Kind::Float;
  unsigned shift = 0;  ///< 1 << shift voxels share a word

  [[nodiscard]] std::size_t words(std::size_t voxels) const noexcept {
    return (voxels + (std::size_t{1} << shift) - 1) >> shift;
  }
  friend bool operator==(const VoxelFormat&, const VoxelFormat&) = default;
};
[[nodiscard]] VoxelFormat voxelFormat(scenegraph::FieldType type) noexcept;

/// Writes `channel` of all cells into words of its format, at the speed of a copy where the values lie side by side.
/// Of integers the offset is what the shader takes off them before they become floats. Any thread.
ChannelValues convertVoxels(const PackedCells& cells, const ChannelInfo& channel, std::span<std::uint32_t> words);

/// Value i as it is compared: of integers sign-extended, of floats their bits.
[[nodiscard]] std::uint32_t rawVoxel(std::span<const std::uint32_t> words, const VoxelFormat& format,
                                     std::size_t i) noexcept;
/// What rawVoxel() gives as a number; NaN where it is missing.
[[nodiscard]] double voxelValue(std::uint32_t raw, const VoxelFormat& format, const ChannelValues& limits) noexcept;

/// Which voxels are drawn, as people say it.
struct VoxelRule {
  enum class Mode : std::uint8_t { All, Above, Range, Equals, Bits };
  Mode mode = Mode::Above;
  double from = 0.0;       ///< Above: exclusive; Range: inclusive; Equals
  double to = 1.0;         ///< Range: inclusive
  std::uint32_t bits = 1;  ///< Bits: any of them
};

/// The same as the shader says it: integers and floats are compared by keys, unsigned numbers in the order of the
/// values, so that it is exact for every type. NaN is drawn by All alone.
struct VoxelTest {
  enum class Mode : std::uint8_t { All = 0, Keys = 1, Bits = 2, None = 3 };  ///< the numbers are the shader's
  Mode mode = Mode::All;
  std::uint32_t first = 0;  ///< keys from here
  std::uint32_t last = 0;   ///< to here
  std::uint32_t bits = 0;

  friend bool operator==(const VoxelTest&, const VoxelTest&) = default;
};
[[nodiscard]] VoxelTest makeVoxelTest(const VoxelRule& rule, scenegraph::FieldType type, const ChannelValues& limits);
/// What the shader computes.
[[nodiscard]] bool isDrawn(std::uint32_t raw, const VoxelFormat& format, const ChannelValues& limits,
                           const VoxelTest& test) noexcept;
[[nodiscard]] std::size_t countDrawn(std::span<const std::uint32_t> words, const VoxelFormat& format,
                                     std::size_t voxels, const ChannelValues& limits, const VoxelTest& test);

/// The voxels that some rule can show: those at the border of the grid, and those with a neighbour of another value. A
/// voxel among equals is enclosed whenever it is drawn. With colours (R, G, B, A words) also those whose neighbour has
/// less alpha, and none without alpha. nullopt when there are more than `most`. O(voxels), a few bytes a nanosecond.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> exposedVoxels(const glm::uvec3& count,
                                                                      std::span<const std::uint32_t> words,
                                                                      const VoxelFormat& format,
                                                                      std::span<const std::uint32_t> rgba,
                                                                      std::size_t most);

}  // namespace stillframe::nodes
