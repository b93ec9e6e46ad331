#include "nodes/images/compressed_depth.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "nodes/images/png_reader.h"
#include "nodes/images/raw_rows.h"
#include "nodes/points/read_value.h"

namespace stillframe::nodes {
namespace {

constexpr std::size_t kHeaderBytes = 12;
constexpr bool kSwapped = std::endian::native == std::endian::big;

std::unexpected<ImageError> corrupt(std::string message) {
  return std::unexpected(ImageError{ImageFault::CorruptImage, std::move(message)});
}

/// Numbers of RVL: groups of three bits in nibbles, the highest bit of a nibble says that another follows; nibbles are
/// taken from the top of little-endian words.
class NibbleReader {
 public:
  explicit NibbleReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  /// nullopt past the end or for more than 32 bits.
  std::optional<std::uint32_t> number() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift <= 30; shift += 3) {
      if (nibbles_ == 0 && !nextWord()) {
        return std::nullopt;
      }
      const std::uint32_t nibble = word_ >> 28U;
      word_ <<= 4U;
      --nibbles_;
      value |= std::uint64_t{nibble & 7U} << shift;
      if ((nibble & 8U) == 0) {
        return value <= 0xFFFF'FFFFU ? std::optional(static_cast<std::uint32_t>(value)) : std::nullopt;
      }
    }
    return std::nullopt;
  }

 private:
  bool nextWord() {
    if (bytes_.size() < sizeof(word_)) {
      return false;
    }
    word_ = readValue<std::uint32_t, kSwapped>(bytes_.data());
    bytes_ = bytes_.subspan(sizeof(word_));
    nibbles_ = 8;
    return true;
  }

  std::span<const std::byte> bytes_;
  std::uint32_t word_ = 0;
  int nibbles_ = 0;
};

std::expected<RawDepth, ImageError> readRvl(std::span<const std::byte> bytes) {
  if (bytes.size() < 8) {
    return corrupt("an RVL image ends after " + std::to_string(bytes.size()) + " of the 8 bytes of its size");
  }
  RawDepth raw{.width = readValue<std::uint32_t, kSwapped>(bytes.data()),
               .height = readValue<std::uint32_t, kSwapped>(bytes.data() + 4),
               .values = {},
               .inverse = {}};
  const std::uint64_t pixels = std::uint64_t{raw.width} * raw.height;
  const std::string what = "an RVL image of " + sizeText(raw.width, raw.height);
  if (pixels > kMaxPixels) {
    return std::unexpected(ImageError{
        ImageFault::ImageTooLarge, what + " is larger than the " + std::to_string(kMaxPixels) + " pixels read here"});
  }
  // The values grow as the stream provides them, so that a lie about the size costs nothing before it is found out.
  NibbleReader reader(bytes.subspan(8));
  std::uint16_t previous = 0;
  while (raw.values.size() < pixels) {
    const auto zeros = reader.number();
    if (!zeros || *zeros > pixels - raw.values.size()) {
      return corrupt(what + " breaks off after " + std::to_string(raw.values.size()) + " pixels");
    }
    raw.values.resize(raw.values.size() + *zeros, 0);
    const auto others = raw.values.size() < pixels ? reader.number() : std::optional<std::uint32_t>(0);
    if (!others || *others > pixels - raw.values.size() || (*zeros == 0 && *others == 0)) {
      return corrupt(what + " breaks off after " + std::to_string(raw.values.size()) + " pixels");
    }
    for (std::uint32_t i = 0; i < *others; ++i) {
      const auto zigzag = reader.number();
      if (!zigzag) {
        return corrupt(what + " breaks off after " + std::to_string(raw.values.size()) + " pixels");
      }
      const std::uint32_t delta = (*zigzag >> 1U) ^ (0U - (*zigzag & 1U));
      previous = static_cast<std::uint16_t>(previous + delta);
      raw.values.push_back(previous);
    }
  }
  return raw;
}

}  // namespace

std::expected<RawDepth, ImageError> readCompressedDepth(std::span<const std::byte> bytes, bool is_float) {
  if (bytes.size() < kHeaderBytes) {
    return corrupt("a compressed depth image ends after " + std::to_string(bytes.size()) + " of the " +
                   std::to_string(kHeaderBytes) + " bytes of its header");
  }
  const float a = readValue<float, kSwapped>(bytes.data() + 4);
  const float b = readValue<float, kSwapped>(bytes.data() + 8);
  if (is_float && (!std::isfinite(a) || !std::isfinite(b) || a <= 0.0F)) {
    return corrupt("a compressed depth image has the quantisation " + std::to_string(a) + ", " + std::to_string(b) +
                   ", which gives no depths");
  }
  const auto body = bytes.subspan(kHeaderBytes);
  std::expected<RawDepth, ImageError> raw;
  if (isPng(body)) {
    auto png = readGray16Png(body);
    if (!png) {
      return std::unexpected(png.error());
    }
    raw = RawDepth{.width = png->width, .height = png->height, .values = std::move(png->values), .inverse = {}};
  } else {
    raw = readRvl(body);
  }
  if (raw && is_float) {
    raw->inverse = {a, b};
  }
  return raw;
}

}  // namespace stillframe::nodes
