#include "scenegraph/pipeline/gl_context_info.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>
#include <string_view>

namespace stillframe::scenegraph {
namespace {

std::string text(GLenum name) {
  const GLubyte* value = glGetString(name);
  return value == nullptr ? std::string() : reinterpret_cast<const char*>(value);
}

bool namesSoftwareRasteriser(std::string_view renderer) {
  for (const std::string_view word : {"llvmpipe", "softpipe", "swrast", "Software Rasterizer", "SWR"}) {
    if (renderer.contains(word)) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::expected<GlContextInfo, Status> inspectCurrentContext() {
  GlContextInfo info{.vendor = text(GL_VENDOR), .renderer = text(GL_RENDERER), .version = text(GL_VERSION)};
  if (info.version.empty()) {
    return std::unexpected(Status{StatusLevel::Error, "WrongOpenGl", "no OpenGL context is current on this thread"});
  }
  GLint major = 0;
  GLint minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  const std::string found = info.version + " on " + info.renderer;
  if (major * 10 + minor < 45) {
    return std::unexpected(Status{StatusLevel::Error, "WrongOpenGl",
                                  "OpenGL 4.5 is needed and the driver gives " + found +
                                      ": update the driver, or set LIBGL_ALWAYS_SOFTWARE=1 to draw on the CPU"});
  }
  GLint profile = 0;
  glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  if ((profile & GL_CONTEXT_COMPATIBILITY_PROFILE_BIT) == 0) {
    return std::unexpected(
        Status{StatusLevel::Error, "WrongOpenGl",
               "the compatibility profile is needed and the context is a core one (" + found +
                   "): ask for CompatibilityProfile with DeprecatedFunctions, or set LIBGL_ALWAYS_SOFTWARE=1"});
  }
  GLint max_size = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &max_size);
  info.max_texture_size = max_size;
  GLint max_texels = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &max_texels);
  info.max_buffer_texels = static_cast<std::uint64_t>(std::max(max_texels, 0));
  info.is_software = namesSoftwareRasteriser(info.renderer);
  return info;
}

}  // namespace stillframe::scenegraph
