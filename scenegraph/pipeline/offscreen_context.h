#pragma once

#include <expected>
#include <memory>

#include "scenegraph/pipeline/gl_context_info.h"
#include "scenegraph/pipeline/gl_debug.h"
#include "scenegraph/status.h"

namespace stillframe::scenegraph {

/// An OpenGL 4.5 compatibility context without window, display server or Qt, through EGL.
///
/// Mesa's surfaceless platform is tried first and kept unless it rasterises on the CPU while a device of a hardware
/// driver (EGL_EXT_platform_device) can do better. It has no default framebuffer. Use it on one thread at a time.
class OffscreenContext {
 public:
  /// A context that is current on this thread, or "NoOpenGl" with everything that was tried.
  [[nodiscard]] static std::expected<std::unique_ptr<OffscreenContext>, Status> create();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// Makes it current on this thread; false when EGL refuses (it is current elsewhere).
  bool makeCurrent();
  /// Leaves this thread without a context.
  void doneCurrent();

  [[nodiscard]] const GlContextInfo& info() const noexcept { return info_; }
  [[nodiscard]] bool isSoftware() const noexcept { return info_.is_software; }
  /// Debug messages since creation: the context is made with the debug flag.
  [[nodiscard]] GlDebugLog& debugLog() noexcept { return debug_log_; }

 private:
  OffscreenContext(void* display, void* context) : display_(display), context_(context) {}
  [[nodiscard]] static std::expected<std::unique_ptr<OffscreenContext>, std::string> createOn(void* display);

  void* display_;  // EGLDisplay; never terminated, for the process has one for each platform
  void* context_;  // EGLContext
  GlContextInfo info_;
  GlDebugLog debug_log_;
};

}  // namespace stillframe::scenegraph
