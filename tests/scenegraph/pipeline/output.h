#pragma once

// Before OSG's headers, which bring the same ones without prototypes.
#include <GL/gl.h>
#include <GL/glext.h>

#include <array>

namespace stillframe::scenegraph {

/// A framebuffer with an 8-bit colour target, as a widget hands one over.
class Output {
 public:
  using Rgb = std::array<int, 3>;

  Output(int width_px, int height_px) : width_(width_px), height_(height_px) {
    glCreateRenderbuffers(1, &color_);
    glNamedRenderbufferStorage(color_, GL_RGBA8, width_px, height_px);
    glCreateFramebuffers(1, &fbo_);
    glNamedFramebufferRenderbuffer(fbo_, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_);
  }
  ~Output() {
    glDeleteFramebuffers(1, &fbo_);
    glDeleteRenderbuffers(1, &color_);
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  [[nodiscard]] GLuint id() const { return fbo_; }
  /// Bottom row first.
  [[nodiscard]] Rgb pixel(int x, int y) const {
    std::array<GLubyte, 4> rgba{};
    glBindFramebuffer(GL_READ_FRAMEBUFFER, fbo_);
    glReadPixels(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    return {rgba[0], rgba[1], rgba[2]};
  }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  int width_;
  int height_;
  GLuint color_ = 0;
  GLuint fbo_ = 0;
};

}  // namespace stillframe::scenegraph
