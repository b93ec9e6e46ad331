#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "nodes/images/image_error.h"

namespace stillframe::nodes {

/// 16-bit values as a compressedDepth message holds them.
struct RawDepth {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint16_t> values;               ///< 0 = hole
  std::optional<std::pair<float, float>> inverse;  ///< {A, B}: depth is A / (value - B) metres; else millimetres
};

/// Reads the data of a compressedDepth image as ROS's compressed_depth_image_transport writes it: a header of 12 bytes
/// (format, A, B; little-endian), then a PNG of 16 bits, or width, height and an RVL stream (Wilson 2017).
///
/// `is_float`: the image was 32FC1, and its values are inverse depths; the header does not tell. Memory is 2 bytes a
/// pixel, of no more pixels than kMaxPixels, nor than deflate can make of the PNG's bytes. Any thread.
[[nodiscard]] std::expected<RawDepth, ImageError> readCompressedDepth(std::span<const std::byte> bytes, bool is_float);

}  // namespace stillframe::nodes
