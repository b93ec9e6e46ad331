// Any bytes as a Draco stream: an error or a cloud that states the truth about its data, in bounded memory and time.
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "nodes/points/codecs/draco.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace stillframe;
  // A copy of exactly the size, so that one byte too many is caught.
  const auto bytes = std::make_shared<std::vector<std::byte>>(size);
  if (size > 0) {
    std::memcpy(bytes->data(), data, size);
  }
  const auto cloud = nodes::decodeDraco({*bytes, bytes});
  if (cloud) {
    const std::uint64_t points = std::uint64_t{cloud->width} * cloud->height;
    if (cloud->data.bytes.size() != points * cloud->point_step ||
        cloud->data.bytes.size() > nodes::maxDecodedBytes(size)) {
      std::abort();
    }
    for (const auto& field : cloud->fields) {
      if (field.offset + field.count * scenegraph::byteSize(field.type) > cloud->point_step) {
        std::abort();
      }
    }
  } else if (cloud.error().message.empty()) {
    std::abort();
  }
  return 0;
}
