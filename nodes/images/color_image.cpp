#include "nodes/images/color_image.h"

#include <algorithm>
#include <array>

#include "nodes/images/jpeg_reader.h"
#include "nodes/images/png_reader.h"
#include "nodes/images/raw_rows.h"

namespace stillframe::nodes {
namespace {

/// Where a raw pixel keeps its components.
struct RawEncoding {
  std::string_view name;
  std::uint32_t bytes_per_pixel;
  std::array<std::uint8_t, 3> rgb;
};
constexpr std::array<RawEncoding, 8> kRaw{{{"rgb8", 3, {0, 1, 2}},
                                           {"rgba8", 4, {0, 1, 2}},
                                           {"bgr8", 3, {2, 1, 0}},
                                           {"bgra8", 4, {2, 1, 0}},
                                           {"8UC3", 3, {2, 1, 0}},
                                           {"8UC4", 4, {2, 1, 0}},
                                           {"mono8", 1, {0, 0, 0}},
                                           {"8UC1", 1, {0, 0, 0}}}};

std::expected<ColorImage, ImageError> decodeRaw(const scenegraph::Image& image, const RawEncoding& encoding) {
  const auto row_step = checkedRowStep(image, encoding.bytes_per_pixel);
  if (!row_step) {
    return std::unexpected(row_step.error());
  }
  ColorImage color{.width = image.width, .height = image.height, .rgba = {}};
  color.rgba.resize(std::size_t{4} * image.width * image.height);
  std::uint8_t* out = color.rgba.data();
  for (std::uint32_t v = 0; v < image.height; ++v) {
    const std::byte* at = image.data.bytes.data() + v * *row_step;
    for (std::uint32_t u = 0; u < image.width; ++u, at += encoding.bytes_per_pixel) {
      for (const std::uint8_t component : encoding.rgb) {
        *out++ = std::to_integer<std::uint8_t>(at[component]);
      }
      *out++ = 255;
    }
  }
  return color;
}

template <typename Decoded>
std::expected<ColorImage, ImageError> fromFile(std::expected<Decoded, ImageError> decoded) {
  if (!decoded) {
    return std::unexpected(std::move(decoded.error()));
  }
  return ColorImage{decoded->width, decoded->height, std::move(decoded->rgba)};
}

}  // namespace

bool isColorEncoding(std::string_view encoding) noexcept {
  return encoding == "jpeg" || encoding == "png" || std::ranges::find(kRaw, encoding, &RawEncoding::name) != kRaw.end();
}

std::expected<ColorImage, ImageError> decodeColor(const scenegraph::Image& image) {
  if (const auto* const raw = std::ranges::find(kRaw, image.encoding, &RawEncoding::name); raw != kRaw.end()) {
    return decodeRaw(image, *raw);
  }
  if (image.encoding == "jpeg") {
    return fromFile(readJpeg(image.data.bytes));
  }
  if (image.encoding == "png") {
    return fromFile(readRgbaPng(image.data.bytes));
  }
  return std::unexpected(
      ImageError{ImageFault::NotColor, "an image of encoding '" + image.encoding + "' is not read as colour"});
}

}  // namespace stillframe::nodes
