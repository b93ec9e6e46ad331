#pragma once

#include <GL/gl.h>
#include <GL/glext.h>

#include <ostream>

namespace stillframe::scenegraph {

/// Names in use of each kind of object. The driver hands out low names first, so that a leak shows within the range.
struct LiveObjects {
  int textures = 0;
  int framebuffers = 0;
  int renderbuffers = 0;
  int buffers = 0;
  int programs = 0;

  static LiveObjects count() {
    LiveObjects live;
    for (GLuint name = 1; name < 20'000; ++name) {
      live.textures += glIsTexture(name) == GL_TRUE ? 1 : 0;
      live.framebuffers += glIsFramebuffer(name) == GL_TRUE ? 1 : 0;
      live.renderbuffers += glIsRenderbuffer(name) == GL_TRUE ? 1 : 0;
      live.buffers += glIsBuffer(name) == GL_TRUE ? 1 : 0;
      live.programs += glIsProgram(name) == GL_TRUE ? 1 : 0;
    }
    return live;
  }
  friend bool operator==(const LiveObjects&, const LiveObjects&) = default;
};

inline std::ostream& operator<<(std::ostream& out, const LiveObjects& live) {
  return out << live.textures << " textures, " << live.framebuffers << " framebuffers, " << live.renderbuffers
             << " renderbuffers, " << live.buffers << " buffers, " << live.programs << " programs";
}

}  // namespace stillframe::scenegraph
