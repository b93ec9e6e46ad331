#include "scenegraph/pipeline/offscreen_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace stillframe::scenegraph {
namespace {

bool hasWord(const char* list, std::string_view word) {
  return list != nullptr && std::string_view(list).contains(word);
}

std::string lastEglError() {
  switch (eglGetError()) {
    case EGL_SUCCESS:
      return "no reason given";
    case EGL_NOT_INITIALIZED:
      return "EGL_NOT_INITIALIZED (no driver)";
    case EGL_BAD_ALLOC:
      return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE:
      return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
      return "EGL_BAD_CONFIG";
    case EGL_BAD_MATCH:
      return "EGL_BAD_MATCH (no such OpenGL version)";
    case EGL_BAD_DISPLAY:
      return "EGL_BAD_DISPLAY";
    case EGL_BAD_ACCESS:
      return "EGL_BAD_ACCESS";
    default:
      return "an EGL error";
  }
}

EGLDisplay platformDisplay(EGLenum platform, void* native) {
  const auto get = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  return get == nullptr ? EGL_NO_DISPLAY : get(platform, native, nullptr);
}

/// Devices of hardware drivers first, CPU rasterisers last.
std::vector<EGLDeviceEXT> devices() {
  const auto query = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  const auto extensions =
      reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(eglGetProcAddress("eglQueryDeviceStringEXT"));
  std::array<EGLDeviceEXT, 32> found{};
  EGLint count = 0;
  if (query == nullptr || query(static_cast<EGLint>(found.size()), found.data(), &count) == EGL_FALSE) {
    return {};
  }
  std::vector<EGLDeviceEXT> hardware;
  std::vector<EGLDeviceEXT> software;
  for (EGLint i = 0; i < count; ++i) {
    EGLDeviceEXT device = found[static_cast<std::size_t>(i)];
    const bool is_software =
        extensions != nullptr && hasWord(extensions(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
    (is_software ? software : hardware).push_back(device);
  }
  hardware.insert(hardware.end(), software.begin(), software.end());
  return hardware;
}

}  // namespace

std::expected<std::unique_ptr<OffscreenContext>, std::string> OffscreenContext::createOn(void* display) {
  EGLint major = 0;
  EGLint minor = 0;
  if (display == EGL_NO_DISPLAY || eglInitialize(display, &major, &minor) == EGL_FALSE) {
    return std::unexpected("no display: " + lastEglError());
  }
  if (!hasWord(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context")) {
    return std::unexpected("its driver cannot draw without a surface");
  }
  // Surface type 0: no window nor pbuffer is ever made, and some drivers offer neither here.
  const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE ||
      eglChooseConfig(display, wanted.data(), &config, 1, &configs) == EGL_FALSE || configs == 0) {
    return std::unexpected("no configuration for desktop OpenGL: " + lastEglError());
  }
  const std::array<EGLint, 9> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                         4,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         5,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT,
                                         EGL_CONTEXT_OPENGL_DEBUG,
                                         EGL_TRUE,
                                         EGL_NONE};
  EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
  if (context == EGL_NO_CONTEXT) {
    return std::unexpected("no OpenGL 4.5 compatibility context: " + lastEglError());
  }
  std::unique_ptr<OffscreenContext> made{new OffscreenContext(display, context)};
  if (!made->makeCurrent()) {
    return std::unexpected("the context cannot be made current: " + lastEglError());
  }
  auto info = inspectCurrentContext();
  if (!info) {
    return std::unexpected(info.error().message);
  }
  made->info_ = std::move(*info);
  made->debug_log_.install();
  return made;
}

std::expected<std::unique_ptr<OffscreenContext>, Status> OffscreenContext::create() {
  std::string tried;
  std::unique_ptr<OffscreenContext> fallback;
  const char* const client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (hasWord(client, "EGL_MESA_platform_surfaceless")) {
    auto made = createOn(platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr));
    if (made && !(*made)->isSoftware()) {
      return std::move(*made);
    }
    if (made) {
      fallback = std::move(*made);
    } else {
      tried = "Mesa's surfaceless platform: " + made.error();
    }
  } else {
    tried = "Mesa's surfaceless platform: not there";
  }
  int index = 0;
  for (EGLDeviceEXT device : devices()) {
    auto made = createOn(platformDisplay(EGL_PLATFORM_DEVICE_EXT, device));
    if (made && (fallback == nullptr || !(*made)->isSoftware())) {
      return std::move(*made);
    }
    tried += "; EGL device " + std::to_string(index++) + ": " + (made ? "a CPU rasteriser" : made.error());
  }
  if (fallback != nullptr) {
    if (fallback->makeCurrent()) {
      return fallback;
    }
    tried += "; the surfaceless context cannot be made current again: " + lastEglError();
  }
  return std::unexpected(Status{StatusLevel::Error, "NoOpenGl",
                                "no OpenGL 4.5 without a display could be had (tried " + tried +
                                    "); on Debian install libegl1 and libgl1-mesa-dri, or a GPU driver with EGL"});
}

OffscreenContext::~OffscreenContext() {
  if (eglGetCurrentContext() == context_) {
    debug_log_.uninstall();
    doneCurrent();
  }
  eglDestroyContext(display_, context_);
}

bool OffscreenContext::makeCurrent() {
  // The API is a property of the thread, and Qt on EGL may have set another.
  return eglBindAPI(EGL_OPENGL_API) == EGL_TRUE &&
         eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
}

void OffscreenContext::doneCurrent() { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

}  // namespace stillframe::scenegraph
