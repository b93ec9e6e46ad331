#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>
#include <vector>

#include "nodes/images/image_error.h"

namespace stillframe::nodes {

struct RgbaJpeg {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;
};
/// A JPEG as 8 bits of red, green, blue and alpha (255), through libjpeg-turbo. Any thread.
[[nodiscard]] std::expected<RgbaJpeg, ImageError> readJpeg(std::span<const std::byte> bytes);

}  // namespace stillframe::nodes
