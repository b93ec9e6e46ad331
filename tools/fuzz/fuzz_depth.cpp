// An image from the fuzzer, of depth or of colour: decoding must stay inside the data and never make a depth that is
// not finite or a picture of another size than it says.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "nodes/images/color_image.h"
#include "nodes/images/depth_map.h"

namespace {

using namespace stillframe;

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr const char* kEncodings[] = {
      "compressedDepth", "compressedDepth", "compressedDepth", "16UC1", "32FC1", "rgb8", "png", "jpeg"};
  if (size < 5) {
    return 0;
  }
  scenegraph::Image image;
  image.encoding = kEncodings[data[0] % std::size(kEncodings)];
  image.compressed_encoding = (data[0] & 0x80U) != 0 ? "32FC1" : "16UC1";
  image.is_bigendian = (data[0] & 0x40U) != 0;
  // A large size is one of a few bits to the left.
  image.width = static_cast<std::uint32_t>(data[1]) << (data[4] & 0x18U);
  image.height = static_cast<std::uint32_t>(data[2]) << (data[4] & 0x18U);
  image.row_step = data[3];
  // A copy of exactly the size, so that one byte too many is caught.
  const auto bytes = std::make_shared<std::vector<std::byte>>(size - 5);
  if (size > 5) {
    std::memcpy(bytes->data(), data + 5, size - 5);
  }
  image.data = {*bytes, bytes};
  if (const auto map = nodes::decodeDepth(image)) {
    require(map->metres.size() == std::size_t{map->width} * map->height);
    std::size_t valid = 0;
    for (const float metres : map->metres) {
      require(std::isfinite(metres));
      valid += metres > 0.0F ? 1 : 0;
    }
    require(valid == map->valid);
  }
  if (const auto color = nodes::decodeColor(image)) {
    require(color->rgba.size() == std::size_t{4} * color->width * color->height);
  }
  return 0;
}
