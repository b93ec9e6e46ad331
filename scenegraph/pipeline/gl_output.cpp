#include "scenegraph/pipeline/gl_output.h"

#include <GL/gl.h>
#include <GL/glext.h>

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

}  // namespace stillframe::scenegraph::gl
