#pragma once

#include <array>
#include <cstdint>

namespace stillframe::scenegraph::gl {

/// The colours of a framebuffer, kept while that is made anew in another size. Thread of the context only.
class KeptPicture {
 public:
  KeptPicture() = default;
  KeptPicture(const KeptPicture&) = delete;
  KeptPicture& operator=(const KeptPicture&) = delete;

  /// Takes what a framebuffer of this size shows. Nothing is held where there is no memory for it.
  void take(std::uint32_t fbo, int width_px, int height_px);
  [[nodiscard]] bool isEmpty() const noexcept { return fbo_ == 0; }
  /// Puts it into the middle of a framebuffer, pixel by pixel, `background` beside it. Not scaled: the shader for that
  /// takes longer to make, in each context, than what it would bridge.
  void put(std::uint32_t fbo, int width_px, int height_px, const std::array<float, 4>& background) const;
  /// The context that it was taken in must be current.
  void release();
  /// When that context has gone.
  void forget() noexcept { fbo_ = texture_ = 0; }

 private:
  std::uint32_t fbo_ = 0;
  std::uint32_t texture_ = 0;
  int width_px_ = 0;
  int height_px_ = 0;
};

}  // namespace stillframe::scenegraph::gl
