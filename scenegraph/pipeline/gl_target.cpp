#include "scenegraph/pipeline/gl_target.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

namespace stillframe::scenegraph::gl {
namespace {

std::vector<float> read(GLuint texture, GLenum format, std::size_t channels, int width_px, int height_px) {
  std::vector<float> values(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * channels);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glGetTextureImage(texture, 0, format, GL_FLOAT, static_cast<GLsizei>(values.size() * sizeof(float)), values.data());
  return values;
}

}  // namespace

void bindFramebuffer(std::uint32_t fbo) { glBindFramebuffer(GL_FRAMEBUFFER, fbo); }

bool isEnabled(std::uint32_t capability) { return glIsEnabled(capability) == GL_TRUE; }

std::uint32_t incompleteStatus(std::uint32_t color_texture, std::uint32_t depth_texture) {
  GLuint fbo = 0;
  glCreateFramebuffers(1, &fbo);
  glNamedFramebufferTexture(fbo, GL_COLOR_ATTACHMENT0, color_texture, 0);
  glNamedFramebufferTexture(fbo, GL_DEPTH_ATTACHMENT, depth_texture, 0);
  const GLenum status = glCheckNamedFramebufferStatus(fbo, GL_DRAW_FRAMEBUFFER);
  glDeleteFramebuffers(1, &fbo);
  return status == GL_FRAMEBUFFER_COMPLETE ? 0U : status;
}

std::vector<float> readColor(std::uint32_t texture, int width_px, int height_px) {
  return read(texture, GL_RGBA, 4, width_px, height_px);
}

std::vector<float> readDepth(std::uint32_t texture, int width_px, int height_px) {
  return read(texture, GL_DEPTH_COMPONENT, 1, width_px, height_px);
}

}  // namespace stillframe::scenegraph::gl
