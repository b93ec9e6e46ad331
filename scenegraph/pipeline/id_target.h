#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace stillframe::scenegraph::gl {

/// A small framebuffer of whole numbers, four a pixel, and 32-bit float depth: what the id pass draws into. Made with
/// the first begin(), on the context that is current.
class IdTarget {
 public:
  using Id = std::array<std::uint32_t, 4>;

  /// Binds and clears it, ids and depth to 0. False where the driver cannot draw into it.
  [[nodiscard]] bool begin(int side_px);
  /// What was drawn, bottom row first; waits for the GPU.
  void read(std::vector<Id>& ids, std::vector<float>& depths) const;
  /// The context that it was made in must be current.
  void release();
  [[nodiscard]] bool exists() const noexcept { return fbo_ != 0; }

 private:
  std::uint32_t fbo_ = 0;
  std::uint32_t ids_ = 0;
  std::uint32_t depth_ = 0;
  int side_px_ = 0;
};

}  // namespace stillframe::scenegraph::gl
