#include "scenegraph/pipeline/gl_output.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>
#include <cstddef>

namespace stillframe::scenegraph::gl {

Output::Output(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {
  glCreateRenderbuffers(1, &color_);
  glNamedRenderbufferStorage(color_, GL_RGBA8, width_px, height_px);
  glCreateFramebuffers(1, &fbo_);
  glNamedFramebufferRenderbuffer(fbo_, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_);
}

Output::~Output() {
  glDeleteFramebuffers(1, &fbo_);
  glDeleteRenderbuffers(1, &color_);
}

void Output::bind() const { glBindFramebuffer(GL_FRAMEBUFFER, fbo_); }

void Output::read(std::uint32_t* argb) const {
  GLint bound = 0;
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &bound);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, fbo_);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glPixelStorei(GL_PACK_ROW_LENGTH, 0);
  glReadPixels(0, 0, width_px_, height_px_, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, argb);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(bound));
  // OpenGL begins at the bottom.
  const std::ptrdiff_t width = width_px_;
  for (std::ptrdiff_t y = 0; y < height_px_ / 2; ++y) {
    std::swap_ranges(argb + y * width, argb + (y + 1) * width, argb + (height_px_ - 1 - y) * width);
  }
}

}  // namespace stillframe::scenegraph::gl
