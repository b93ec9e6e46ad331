#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <string_view>
#include <vector>

#include "nodes/images/image_error.h"
#include "scenegraph/objects/image.h"

namespace stillframe::nodes {

/// Depth of every pixel, row by row, along the optical axis.
struct DepthMap {
  /// A pixel without depth; finite, because text formats and some drivers do not keep NaN.
  static constexpr float kHole = -3.0e38F;
  /// Depths beyond this (m) are holes: they would overflow the float arithmetic of the picture.
  static constexpr float kReach_m = 1e15F;

  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<float> metres;  ///< width * height values, above zero or kHole
  std::size_t valid = 0;      ///< pixels with a depth
  float nearest_m = 0.0F;     ///< of those; meaningful when valid > 0
  float farthest_m = 0.0F;
};

/// Whether an image of that encoding is one of depth: 16UC1, mono16, 32FC1, compressedDepth.
[[nodiscard]] bool isDepthEncoding(std::string_view encoding) noexcept;

/// Depth in metres: 16UC1 and mono16 (millimetres) and 32FC1 (metres) in either byte order and with padded rows, and
/// compressedDepth. 0, negative values, NaN and infinities are holes. Any thread; memory is 4 bytes a pixel, and 2 more
/// on the way for compressed ones.
[[nodiscard]] std::expected<DepthMap, ImageError> decodeDepth(const scenegraph::Image& image);

}  // namespace stillframe::nodes
