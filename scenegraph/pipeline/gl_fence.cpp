#include "scenegraph/pipeline/gl_fence.h"

#include <GL/gl.h>
#include <GL/glext.h>

namespace stillframe::scenegraph::gl {

Fence::Fence() : sync_(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)) {
  glFlush();  // or what is before it may never begin
}

Fence::~Fence() { glDeleteSync(static_cast<GLsync>(sync_)); }

bool Fence::isReached(double wait_ms) const {
  const GLenum status = glClientWaitSync(static_cast<GLsync>(sync_), 0, static_cast<GLuint64>(wait_ms * 1e6));
  return status != GL_TIMEOUT_EXPIRED;  // one that failed is waited for no longer
}

}  // namespace stillframe::scenegraph::gl
