#include "scenegraph/pipeline/gl_target.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>

#include "scenegraph/pipeline/half_float.h"

namespace stillframe::scenegraph::gl {
namespace {

/// Texels of level 0, `channels` values each.
template <typename T>
std::vector<T> read(GLuint texture, GLenum format, GLenum type, std::size_t channels, const Rows& rows) {
  std::vector<T> values(static_cast<std::size_t>(rows.width_px) * static_cast<std::size_t>(rows.count) * channels);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 2);
  glGetTextureSubImage(texture, 0, 0, rows.first, 0, rows.width_px, rows.count, 1, format, type,
                       static_cast<GLsizei>(values.size() * sizeof(T)), values.data());
  return values;
}

}  // namespace

void bindFramebuffer(std::uint32_t fbo) { glBindFramebuffer(GL_FRAMEBUFFER, fbo); }

void selectTextureUnits(std::uint32_t unit, std::uint32_t client_unit) {
  glActiveTexture(GL_TEXTURE0 + unit);
  glClientActiveTexture(GL_TEXTURE0 + client_unit);
}

void clearColor(std::uint32_t fbo, const std::array<float, 4>& rgba) {
  glClearNamedFramebufferfv(fbo, GL_COLOR, 0, rgba.data());
}

void copyColors(std::uint32_t from_fbo, std::uint32_t to_fbo, int width_px, int height_px) {
  const bool is_clipped = isEnabled(GL_SCISSOR_TEST);
  glDisable(GL_SCISSOR_TEST);
  glBlitNamedFramebuffer(from_fbo, to_fbo, 0, 0, width_px, height_px, 0, 0, width_px, height_px, GL_COLOR_BUFFER_BIT,
                         GL_NEAREST);
  if (is_clipped) {
    glEnable(GL_SCISSOR_TEST);
  }
}

void finish() { glFinish(); }

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

int maxSamples() {
  GLint colors = 1;
  GLint depths = 1;
  glGetIntegerv(GL_MAX_COLOR_TEXTURE_SAMPLES, &colors);
  glGetIntegerv(GL_MAX_DEPTH_TEXTURE_SAMPLES, &depths);
  return std::min(colors, depths);
}

std::uint32_t makeSampledTexture(std::uint32_t internal_format, int samples, int width_px, int height_px) {
  GLuint texture = 0;
  glCreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &texture);
  glTextureStorage2DMultisample(texture, samples, internal_format, width_px, height_px, GL_TRUE);
  return texture;
}

void deleteTexture(std::uint32_t texture) { glDeleteTextures(1, &texture); }

std::uint32_t makeNumbers(int width, int height, int layers, int channels) {
  const GLenum format = channels == 1 ? GL_R32UI : GL_RGBA32UI;
  GLuint texture = 0;
  while (glGetError() != GL_NO_ERROR) {
  }
  if (layers > 0) {
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &texture);
    glTextureStorage3D(texture, 1, format, width, height, layers);
  } else {
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, width, height);
  }
  if (glGetError() != GL_NO_ERROR) {
    glDeleteTextures(1, &texture);
    return 0;
  }
  return texture;
}

void clearNumbers(std::uint32_t texture) { glClearTexImage(texture, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr); }

void bindNumbers(std::uint32_t unit, std::uint32_t texture, int channels) {
  glBindImageTexture(unit, texture, 0, GL_TRUE, 0, GL_READ_WRITE, channels == 1 ? GL_R32UI : GL_RGBA32UI);
}

void finishImages() { glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT); }

void finishTargets() { glTextureBarrier(); }

std::uint32_t readNumber(std::uint32_t texture) {
  std::uint32_t number = 0;
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glGetTextureImage(texture, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, sizeof(number), &number);
  return number;
}

void writePixels(std::uint32_t color_texture, std::uint32_t depth_texture, int width_px, int height_px,
                 const std::uint16_t* rgba, const float* depths) {
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glTextureSubImage2D(color_texture, 0, 0, 0, width_px, height_px, GL_RGBA, GL_HALF_FLOAT, rgba);
  glTextureSubImage2D(depth_texture, 0, 0, 0, width_px, height_px, GL_DEPTH_COMPONENT, GL_FLOAT, depths);
}

std::vector<float> readColor(std::uint32_t texture, const Rows& rows) {
  GLint format = 0;
  glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
  if (format != GL_RGBA16F) {
    return read<float>(texture, GL_RGBA, GL_FLOAT, 4, rows);
  }
  // As the halves they are: the driver takes longer to make floats of them.
  const auto halves = read<std::uint16_t>(texture, GL_RGBA, GL_HALF_FLOAT, 4, rows);
  std::vector<float> values(halves.size());
  std::ranges::transform(halves, values.begin(), floatFromHalf);
  return values;
}

std::vector<float> readDepth(std::uint32_t texture, const Rows& rows) {
  return read<float>(texture, GL_DEPTH_COMPONENT, GL_FLOAT, 1, rows);
}

}  // namespace stillframe::scenegraph::gl
