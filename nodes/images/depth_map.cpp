#include "nodes/images/depth_map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>

#include "nodes/images/compressed_depth.h"
#include "nodes/images/raw_rows.h"
#include "nodes/points/read_value.h"

namespace stillframe::nodes {
namespace {

constexpr double kMetresPerUnit = 0.001;  // REP 118: 16UC1 is millimetres

float metresOf(std::uint16_t raw) {
  return raw == 0 ? DepthMap::kHole : static_cast<float>(static_cast<double>(raw) * kMetresPerUnit);
}
// The comparison is false for NaN.
float metresOf(float raw) { return raw > 0.0F && raw <= DepthMap::kReach_m ? raw : DepthMap::kHole; }

template <typename T, bool kSwapped>
void readRows(const scenegraph::Image& image, std::size_t row_step, std::vector<float>& metres) {
  float* out = metres.data();
  for (std::uint32_t v = 0; v < image.height; ++v) {
    const std::byte* at = image.data.bytes.data() + v * row_step;
    for (std::uint32_t u = 0; u < image.width; ++u, at += sizeof(T)) {
      *out++ = metresOf(readValue<T, kSwapped>(at));
    }
  }
}

void summarise(DepthMap& map) {
  float nearest = DepthMap::kReach_m;
  float farthest = 0.0F;
  std::size_t valid = 0;
  for (const float metres : map.metres) {
    const bool is_valid = metres > 0.0F;
    valid += is_valid ? 1 : 0;
    nearest = is_valid ? std::min(nearest, metres) : nearest;
    farthest = std::max(farthest, metres);
  }
  map.valid = valid;
  map.nearest_m = valid > 0 ? nearest : 0.0F;
  map.farthest_m = farthest;
}

std::expected<DepthMap, ImageError> decodeRaw(const scenegraph::Image& image) {
  const bool is_float = image.encoding == "32FC1";
  const auto row_step = checkedRowStep(image, is_float ? sizeof(float) : sizeof(std::uint16_t));
  if (!row_step) {
    return std::unexpected(row_step.error());
  }
  DepthMap map{.width = image.width, .height = image.height, .metres = {}};
  map.metres.resize(std::size_t{image.width} * image.height);
  const bool is_swapped = image.is_bigendian != (std::endian::native == std::endian::big);
  if (is_float) {
    is_swapped ? readRows<float, true>(image, *row_step, map.metres)
               : readRows<float, false>(image, *row_step, map.metres);
  } else {
    is_swapped ? readRows<std::uint16_t, true>(image, *row_step, map.metres)
               : readRows<std::uint16_t, false>(image, *row_step, map.metres);
  }
  return map;
}

std::expected<DepthMap, ImageError> decodeCompressed(const scenegraph::Image& image) {
  const auto raw = readCompressedDepth(image.data.bytes, image.compressed_encoding == "32FC1");
  if (!raw) {
    return std::unexpected(raw.error());
  }
  DepthMap map{.width = raw->width, .height = raw->height, .metres = {}};
  map.metres.resize(raw->values.size());
  if (raw->inverse) {
    const auto [a, b] = *raw->inverse;
    std::ranges::transform(raw->values, map.metres.begin(), [a, b](std::uint16_t value) {
      return value == 0 ? DepthMap::kHole : metresOf(a / (static_cast<float>(value) - b));
    });
  } else {
    std::ranges::transform(raw->values, map.metres.begin(), [](std::uint16_t value) { return metresOf(value); });
  }
  return map;
}

}  // namespace

bool isDepthEncoding(std::string_view encoding) noexcept {
  return encoding == "16UC1" || encoding == "mono16" || encoding == "32FC1" || encoding == "compressedDepth";
}

std::expected<DepthMap, ImageError> decodeDepth(const scenegraph::Image& image) {
  if (!isDepthEncoding(image.encoding)) {
    return std::unexpected(
        ImageError{ImageFault::NotDepth,
                   "an image of encoding '" + image.encoding +
                       "' has no depth and is not shown in 3D; depth is 16UC1, mono16, 32FC1 or compressedDepth"});
  }
  auto map = image.encoding == "compressedDepth" ? decodeCompressed(image) : decodeRaw(image);
  if (map) {
    summarise(*map);
  }
  return map;
}

}  // namespace stillframe::nodes
