#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>
#include <vector>

#include "nodes/images/image_error.h"

namespace stillframe::nodes {

struct Gray16Png {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint16_t> values;  ///< as stored: no gamma, native byte order
};
struct RgbaPng {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;
};

[[nodiscard]] bool isPng(std::span<const std::byte> bytes) noexcept;
/// A grey PNG of 16 bits, through libpng. Memory is bounded by what deflate can make of so many bytes. Any thread.
[[nodiscard]] std::expected<Gray16Png, ImageError> readGray16Png(std::span<const std::byte> bytes);
/// Any PNG as 8 bits of red, green, blue and alpha; the same bounds.
[[nodiscard]] std::expected<RgbaPng, ImageError> readRgbaPng(std::span<const std::byte> bytes);

}  // namespace stillframe::nodes
