#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scenegraph/objects/payload.h"

namespace stillframe::bench {

/// One scan of a spinning lidar, as it is and as either codec packs it: x, y, z, intensity FLOAT32 and ring UINT16.
struct CodecWorkload {
  std::vector<std::byte> points;
  scenegraph::Payload cloudini;  ///< version 5, lossy to a millimetre, zstd
  scenegraph::Payload draco;     ///< sequential, positions in 14 bits
};
[[nodiscard]] CodecWorkload makeCodecWorkload(std::uint32_t points);

/// libdraco alone, its result thrown away; false when it fails.
[[nodiscard]] bool decodeBareDraco(const scenegraph::Payload& blob);

}  // namespace stillframe::bench
