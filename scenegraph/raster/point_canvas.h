#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "scenegraph/raster/box_on_screen.h"

namespace stillframe::scenegraph {

inline constexpr std::int32_t kSubpixels = 256;

/// Pixels of one axis: first and end.
struct PixelSpan {
  std::int32_t first;
  std::int32_t end;
};

/// Of a disc: pixels whose centres lie within `size` about the centre, all in 1/256 of a pixel.
inline PixelSpan coveredByDisc(std::int32_t centre, std::int32_t size, std::int32_t limit_px) {
  const std::int32_t low = centre - kSubpixels / 2 - size / 2;
  return {std::max((low + kSubpixels - 1) >> 8, 0), std::min((low + size + kSubpixels - 1) >> 8, limit_px)};
}

/// Of a square: OpenGL moves it on to the grid of pixels (4.6, 14.4: an odd width to a pixel's centre, an even one to a
/// corner).
inline PixelSpan coveredBySquare(std::int32_t centre, std::int32_t size_px, std::int32_t limit_px) {
  const std::int32_t first = ((centre + (size_px % 2 == 0 ? kSubpixels / 2 : 0)) >> 8) - size_px / 2;
  return {std::max(first, 0), std::min(first + size_px, limit_px)};
}

/// The picture of keys that all threads of a PointRaster write into. Coordinates are in 1/256 of a pixel.
class PointCanvas {
 public:
  PointCanvas(std::uint64_t* keys, int width_px, int height_px)
      : keys_(keys), width_px_(width_px), height_px_(height_px) {}

  void onePixel(std::int32_t x, std::int32_t y, std::uint64_t key) const {
    const std::int32_t column = std::min(x >> 8, width_px_ - 1);
    const std::int32_t row = std::min(y >> 8, height_px_ - 1);
    store(static_cast<std::size_t>(row) * static_cast<std::size_t>(width_px_) + static_cast<std::size_t>(column), key);
  }

  void square(std::int32_t x, std::int32_t y, float size_px, std::uint64_t key) const {
    const auto size = static_cast<std::int32_t>(std::lrint(size_px));
    const PixelSpan columns = coveredBySquare(x, size, width_px_);
    const PixelSpan rows = coveredBySquare(y, size, height_px_);
    for (std::int32_t row = rows.first; row < rows.end; ++row) {
      const std::size_t begin = static_cast<std::size_t>(row) * static_cast<std::size_t>(width_px_);
      for (std::int32_t column = columns.first; column < columns.end; ++column) {
        store(begin + static_cast<std::size_t>(column), key);
      }
    }
  }

  void disc(std::int32_t x, std::int32_t y, float size_px, std::uint64_t key) const {
    const auto size = static_cast<std::int32_t>(size_px * static_cast<float>(kSubpixels) + 0.5F);
    const PixelSpan columns = coveredByDisc(x, size, width_px_);
    const PixelSpan rows = coveredByDisc(y, size, height_px_);
    const std::int64_t reach = std::int64_t{size} * size;
    for (std::int32_t row = rows.first; row < rows.end; ++row) {
      const std::int64_t from_y = 2 * (std::int64_t{row} * kSubpixels + kSubpixels / 2 - y);
      const std::size_t begin = static_cast<std::size_t>(row) * static_cast<std::size_t>(width_px_);
      for (std::int32_t column = columns.first; column < columns.end; ++column) {
        const std::int64_t from_x = 2 * (std::int64_t{column} * kSubpixels + kSubpixels / 2 - x);
        if (from_x * from_x + from_y * from_y <= reach) {
          store(begin + static_cast<std::size_t>(column), key);
        }
      }
    }
  }

  /// Whether all that may fall there lies behind what has been drawn. Gives up where that is more to read than
  /// `most_pixels`.
  [[nodiscard]] bool isHidden(const BoxOnScreen& place, double size_px, std::size_t most_pixels) const {
    const double reach = 0.5 * std::max(1.0, size_px) + 1.0;
    const auto pixelAt = [](double at, int limit) {
      return static_cast<std::size_t>(std::clamp(std::floor(at), 0.0, static_cast<double>(limit)));
    };
    const std::size_t first_column = pixelAt(place.low_px.x - reach, width_px_);
    const std::size_t end_column = pixelAt(place.high_px.x + reach + 1.0, width_px_);
    const std::size_t first_row = pixelAt(place.low_px.y - reach, height_px_);
    const std::size_t end_row = pixelAt(place.high_px.y + reach + 1.0, height_px_);
    if ((end_column - first_column) * (end_row - first_row) > most_pixels) {
      return false;
    }
    for (std::size_t row = first_row; row < end_row; ++row) {
      for (std::size_t column = first_column; column < end_column; ++column) {
        const std::size_t pixel = row * static_cast<std::size_t>(width_px_) + column;
        const std::uint64_t seen = std::atomic_ref<std::uint64_t>{keys_[pixel]}.load(std::memory_order_relaxed);
        if (!(static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(seen >> 32U))) > place.nearest)) {
          return false;
        }
      }
    }
    return true;
  }

 private:
  void store(std::size_t pixel, std::uint64_t key) const {
    const std::atomic_ref<std::uint64_t> seen{keys_[pixel]};
    std::uint64_t there = seen.load(std::memory_order_relaxed);
    while (there < key && !seen.compare_exchange_weak(there, key, std::memory_order_relaxed)) {
    }
  }

  std::uint64_t* keys_;
  int width_px_;
  int height_px_;
};

}  // namespace stillframe::scenegraph
