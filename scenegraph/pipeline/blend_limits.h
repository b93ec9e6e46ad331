#pragma once

#include <cstdint>

namespace stillframe::scenegraph {

/// How far what is blended is kept and put in order.
struct BlendLimits {
  int most_sorted = 64;  ///< fragments of a sample in order; those behind count by their mean. 0: weighted blending
  std::uint32_t most_fragments = 1U << 24U;  ///< kept at a time, 16 bytes each; a picture with more comes in bands
  friend bool operator==(const BlendLimits&, const BlendLimits&) = default;
};

}  // namespace stillframe::scenegraph
