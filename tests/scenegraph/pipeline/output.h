#pragma once

#include "scenegraph/pipeline/gl_output.h"

// Before OSG's headers, which bring the same ones without prototypes.
#include <GL/gl.h>
#include <GL/glext.h>

#include <array>

namespace stillframe::scenegraph {

/// A framebuffer whose pixels can be looked at.
class Output : public gl::Output {
 public:
  using Rgb = std::array<int, 3>;
  using gl::Output::Output;

  /// Bottom row first.
  [[nodiscard]] Rgb pixel(int x, int y) const {
    std::array<GLubyte, 4> rgba{};
    glBindFramebuffer(GL_READ_FRAMEBUFFER, id());
    glReadPixels(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    return {rgba[0], rgba[1], rgba[2]};
  }
};

}  // namespace stillframe::scenegraph
