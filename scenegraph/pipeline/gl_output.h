#pragma once

#include <cstdint>

namespace stillframe::scenegraph::gl {

/// A framebuffer of 8-bit colour, as a widget hands one over, for who has no window. Made, used and destroyed with its
/// context current.
class Output {
 public:
  Output(int width_px, int height_px);
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  void bind() const;
  /// Its pixels, 0xAARRGGBB each, the top row first; `argb` has room for all. Waits until they are drawn.
  void read(std::uint32_t* argb) const;
  [[nodiscard]] std::uint32_t id() const noexcept { return fbo_; }
  [[nodiscard]] int width() const noexcept { return width_px_; }
  [[nodiscard]] int height() const noexcept { return height_px_; }

 private:
  int width_px_;
  int height_px_;
  std::uint32_t color_ = 0;
  std::uint32_t fbo_ = 0;
};

}  // namespace stillframe::scenegraph::gl
