#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace stillframe::nodes {

/// Why an image could not be decoded.
enum class ImageFault : std::uint8_t {
  NotDepth,        ///< its encoding is none of depth
  NotColor,        ///< its encoding is none of colour
  TruncatedImage,  ///< fewer bytes than its size and row step need
  BadImageSize,    ///< rows shorter than their pixels, or one side zero and the other not
  ImageTooLarge,   ///< more pixels than kMaxPixels, or than its compressed bytes can hold
  CorruptImage,    ///< the compressed bytes are not what they claim
};

/// Enumerator name.
[[nodiscard]] constexpr std::string_view toString(ImageFault fault) noexcept {
  switch (fault) {
    case ImageFault::NotDepth:
      return "NotDepth";
    case ImageFault::NotColor:
      return "NotColor";
    case ImageFault::TruncatedImage:
      return "TruncatedImage";
    case ImageFault::BadImageSize:
      return "BadImageSize";
    case ImageFault::ImageTooLarge:
      return "ImageTooLarge";
    case ImageFault::CorruptImage:
      return "CorruptImage";
  }
  return "";
}

struct ImageError {
  ImageFault code = ImageFault::CorruptImage;
  std::string message;  ///< one sentence with sizes
};

/// Bound of the pixels of one image (8192 x 8192): no header makes us ask for more memory than that needs.
inline constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 26U;

}  // namespace stillframe::nodes
