#include "scenegraph/pipeline/kept_picture.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>

#include "scenegraph/pipeline/gl_target.h"

namespace stillframe::scenegraph::gl {

void KeptPicture::take(std::uint32_t fbo, int width_px, int height_px) {
  release();
  if (width_px <= 0 || height_px <= 0) {
    return;
  }
  width_px_ = width_px;
  height_px_ = height_px;
  glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
  glTextureStorage2D(texture_, 1, GL_RGBA8, width_px, height_px);
  glCreateFramebuffers(1, &fbo_);
  glNamedFramebufferTexture(fbo_, GL_COLOR_ATTACHMENT0, texture_, 0);
  if (glCheckNamedFramebufferStatus(fbo_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    release();
    return;
  }
  glBlitNamedFramebuffer(fbo, fbo_, 0, 0, width_px, height_px, 0, 0, width_px, height_px, GL_COLOR_BUFFER_BIT,
                         GL_NEAREST);
}

void KeptPicture::put(std::uint32_t fbo, int width_px, int height_px, const std::array<float, 4>& background) const {
  clearColor(fbo, background);
  if (isEmpty() || width_px <= 0 || height_px <= 0) {
    return;
  }
  const int width = std::min(width_px_, width_px);
  const int height = std::min(height_px_, height_px);
  const int from_x = (width_px_ - width) / 2;
  const int from_y = (height_px_ - height) / 2;
  const int to_x = (width_px - width) / 2;
  const int to_y = (height_px - height) / 2;
  glBlitNamedFramebuffer(fbo_, fbo, from_x, from_y, from_x + width, from_y + height, to_x, to_y, to_x + width,
                         to_y + height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void KeptPicture::release() {
  if (fbo_ != 0) {
    glDeleteFramebuffers(1, &fbo_);
    glDeleteTextures(1, &texture_);
  }
  forget();
}

}  // namespace stillframe::scenegraph::gl
