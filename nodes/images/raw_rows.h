#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <string>

#include "nodes/images/image_error.h"
#include "scenegraph/objects/image.h"

namespace stillframe::nodes {

[[nodiscard]] inline std::string sizeText(std::uint64_t width, std::uint64_t height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

/// Bytes from one row to the next of an uncompressed image, after checking that all of its pixels are in the data.
/// row_step 0 is read as no padding.
[[nodiscard]] inline std::expected<std::size_t, ImageError> checkedRowStep(const scenegraph::Image& image,
                                                                           std::uint32_t bytes_per_pixel) {
  const std::uint64_t width = image.width;
  const std::uint64_t height = image.height;
  const std::string what = "an image of " + sizeText(width, height) + " " + image.encoding;
  if ((width == 0) != (height == 0)) {
    return std::unexpected(ImageError{ImageFault::BadImageSize, what + " has one side of no length"});
  }
  if (width == 0) {
    return 0;
  }
  const std::uint64_t row_bytes = width * bytes_per_pixel;
  const std::uint64_t step = image.row_step == 0 ? row_bytes : image.row_step;
  if (step < row_bytes) {
    return std::unexpected(ImageError{ImageFault::BadImageSize, what + " needs rows of " + std::to_string(row_bytes) +
                                                                    " bytes, not of " + std::to_string(step)});
  }
  if (width * height > kMaxPixels) {
    return std::unexpected(ImageError{
        ImageFault::ImageTooLarge, what + " is larger than the " + std::to_string(kMaxPixels) + " pixels read here"});
  }
  if (const std::uint64_t needed = (height - 1) * step + row_bytes; needed > image.data.bytes.size()) {
    return std::unexpected(ImageError{
        ImageFault::TruncatedImage,
        what + " needs " + std::to_string(needed) + " bytes and has " + std::to_string(image.data.bytes.size())});
  }
  return static_cast<std::size_t>(step);
}

}  // namespace stillframe::nodes
