#include <algorithm>
#include <bit>
#include <cstring>

#include "nodes/voxel_grid/voxel_values.h"

namespace stillframe::nodes {
namespace {

/// Marks where `row` differs from `other`, voxel for voxel.
template <typename T>
void markDifferent(const T* row, const T* other, std::size_t count, std::uint8_t* exposed) {
  for (std::size_t i = 0; i < count; ++i) {
    exposed[i] = static_cast<std::uint8_t>(exposed[i] | static_cast<std::uint8_t>(row[i] != other[i]));
  }
}

/// Marks where `other` has less alpha than `row`.
void markLessAlpha(const std::uint32_t* row, const std::uint32_t* other, std::size_t count, std::uint8_t* exposed) {
  for (std::size_t i = 0; i < count; ++i) {
    exposed[i] = static_cast<std::uint8_t>(exposed[i] | static_cast<std::uint8_t>(other[i] >> 24U < row[i] >> 24U));
  }
}

/// Calls `mark(row, other, count, exposed)` for the six neighbours of each row's voxels.
template <typename T, typename Mark>
void markRow(const T* values, const glm::uvec3& count, std::uint32_t y, std::uint32_t z, const Mark& mark,
             std::uint8_t* exposed) {
  const std::size_t columns = count.x;
  const std::size_t in_slice = columns * count.y;
  const T* const row = values + z * in_slice + y * columns;
  if (columns > 1) {
    mark(row, row + 1, columns - 1, exposed);
    mark(row + 1, row, columns - 1, exposed + 1);
  }
  if (y > 0) {
    mark(row, row - columns, columns, exposed);
  }
  if (y + 1 < count.y) {
    mark(row, row + columns, columns, exposed);
  }
  if (z > 0) {
    mark(row, row - in_slice, columns, exposed);
  }
  if (z + 1 < count.z) {
    mark(row, row + in_slice, columns, exposed);
  }
}

/// Appends the numbers of the marked voxels; false when that makes more than `most`.
bool append(const std::vector<std::uint8_t>& exposed, std::size_t first, std::size_t most,
            std::vector<std::uint32_t>& all) {
  std::size_t i = 0;
  while (i < exposed.size()) {
    std::uint64_t eight = 0;
    if (i + sizeof(eight) <= exposed.size()) {
      std::memcpy(&eight, &exposed[i], sizeof(eight));
      if (eight == 0) {
        i += sizeof(eight);
        continue;
      }
    }
    if (exposed[i] != 0) {
      all.push_back(static_cast<std::uint32_t>(first + i));
    }
    ++i;
  }
  return all.size() <= most;
}

template <typename T>
std::optional<std::vector<std::uint32_t>> find(const glm::uvec3& count, const T* values, const std::uint32_t* rgba,
                                               std::size_t most) {
  std::vector<std::uint32_t> all;
  std::vector<std::uint8_t> exposed(count.x);
  std::size_t first = 0;
  for (std::uint32_t z = 0; z < count.z; ++z) {
    for (std::uint32_t y = 0; y < count.y; ++y, first += count.x) {
      const bool is_border = y == 0 || z == 0 || y + 1 == count.y || z + 1 == count.z;
      std::ranges::fill(exposed, static_cast<std::uint8_t>(is_border));
      exposed.front() = exposed.back() = 1;
      if (!is_border && values != nullptr) {
        markRow(values, count, y, z, &markDifferent<T>, exposed.data());
      }
      if (rgba != nullptr) {
        if (!is_border) {
          markRow(rgba, count, y, z, &markLessAlpha, exposed.data());
        }
        for (std::size_t i = 0; i < count.x; ++i) {
          exposed[i] = static_cast<std::uint8_t>(exposed[i] & static_cast<std::uint8_t>(rgba[first + i] >> 24U != 0));
        }
      }
      if (!append(exposed, first, most, all)) {
        return std::nullopt;
      }
    }
  }
  return all;
}

}  // namespace

std::optional<std::vector<std::uint32_t>> exposedVoxels(const glm::uvec3& count, std::span<const std::uint32_t> words,
                                                        const VoxelFormat& format, std::span<const std::uint32_t> rgba,
                                                        std::size_t most) {
  if (count.x == 0 || count.y == 0 || count.z == 0) {
    return std::vector<std::uint32_t>{};
  }
  const std::uint32_t* const colors = rgba.empty() ? nullptr : rgba.data();
  const auto* const bytes = words.empty() ? nullptr : reinterpret_cast<const std::byte*>(words.data());
  switch (format.shift) {
    case 2:
      return find(count, reinterpret_cast<const std::uint8_t*>(bytes), colors, most);
    case 1:
      return find(count, reinterpret_cast<const std::uint16_t*>(bytes), colors, most);
    default:
      return find(count, reinterpret_cast<const std::uint32_t*>(bytes), colors, most);
  }
}

}  // namespace stillframe::nodes
