#pragma once

#include <array>
#include <cstddef>

namespace stillframe::nodes {

/// Box of points, floats.
struct FloatBox {
  std::array<float, 3> low;
  std::array<float, 3> high;
};

/// Points that copyPoints() takes at a time.
inline constexpr std::size_t kCopyBlock = 8;

struct CopiedPoints {
  std::size_t blocks = 0;  ///< copied, of kCopyBlock points each
  std::size_t doubtful =
      0;  ///< points behind them to look at one by one: some coordinate is not finite or out of reach
};

/// Copies native float x, y, z of points that lie `step` bytes apart, and grows `box` by them: the loop that decides
/// how fast a cloud is converted.
///
/// Reads 16 bytes at each point and writes 12, of the last one the fourth float too. Any thread.
[[nodiscard]] CopiedPoints copyPoints(const std::byte* points, std::size_t step, std::size_t blocks, float reach,
                                      float* out, FloatBox& box);

}  // namespace stillframe::nodes
