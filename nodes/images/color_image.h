#pragma once

#include <cstdint>
#include <expected>
#include <string_view>
#include <vector>

#include "nodes/images/image_error.h"
#include "scenegraph/objects/image.h"

namespace stillframe::nodes {

/// Colour of every pixel, row by row, sRGB-encoded.
struct ColorImage {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;
};

/// rgb8, rgba8, bgr8, bgra8 (and ROS's 8UC3 and 8UC4, which are bgr), mono8, jpeg, png.
[[nodiscard]] bool isColorEncoding(std::string_view encoding) noexcept;

/// Any colour encoding, with padded rows where it is raw. Any thread; memory is 4 bytes a pixel.
[[nodiscard]] std::expected<ColorImage, ImageError> decodeColor(const scenegraph::Image& image);

}  // namespace stillframe::nodes
