#include "scenegraph/pipeline/id_target.h"

#include <GL/gl.h>
#include <GL/glext.h>

namespace stillframe::scenegraph::gl {

bool IdTarget::begin(int side_px) {
  if (fbo_ == 0 || side_px != side_px_) {
    release();
    side_px_ = side_px;
    glCreateFramebuffers(1, &fbo_);
    glCreateRenderbuffers(1, &ids_);
    glCreateRenderbuffers(1, &depth_);
    glNamedRenderbufferStorage(ids_, GL_RGBA32UI, side_px, side_px);
    glNamedRenderbufferStorage(depth_, GL_DEPTH_COMPONENT32F, side_px, side_px);
    glNamedFramebufferRenderbuffer(fbo_, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, ids_);
    glNamedFramebufferRenderbuffer(fbo_, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
    if (glCheckNamedFramebufferStatus(fbo_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      release();
      return false;
    }
  }
  glBindFramebuffer(GL_FRAMEBUFFER, fbo_);
  constexpr std::array<GLuint, 4> kNothing{};
  constexpr GLfloat kInfinitelyFar = 0.0F;
  glClearNamedFramebufferuiv(fbo_, GL_COLOR, 0, kNothing.data());
  glClearNamedFramebufferfv(fbo_, GL_DEPTH, 0, &kInfinitelyFar);
  return true;
}

void IdTarget::read(std::vector<Id>& ids, std::vector<float>& depths) const {
  const auto pixels = static_cast<std::size_t>(side_px_) * static_cast<std::size_t>(side_px_);
  ids.resize(pixels);
  depths.resize(pixels);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, side_px_, side_px_, GL_RGBA_INTEGER, GL_UNSIGNED_INT, ids.data());
  glReadPixels(0, 0, side_px_, side_px_, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
}

void IdTarget::release() {
  if (fbo_ != 0) {
    glDeleteFramebuffers(1, &fbo_);
    glDeleteRenderbuffers(1, &ids_);
    glDeleteRenderbuffers(1, &depth_);
  }
  fbo_ = ids_ = depth_ = 0;
}

}  // namespace stillframe::scenegraph::gl
