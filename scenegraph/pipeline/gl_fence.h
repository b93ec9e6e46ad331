#pragma once

namespace stillframe::scenegraph::gl {

/// A mark behind all that was asked for so far (GL_ARB_sync): whether OpenGL has drawn it. Made, asked and destroyed
/// with its context current.
class Fence {
 public:
  Fence();
  ~Fence();
  Fence(const Fence&) = delete;
  Fence& operator=(const Fence&) = delete;

  /// Waits that long at most.
  [[nodiscard]] bool isReached(double wait_ms) const;

 private:
  void* sync_;  // GLsync
};

}  // namespace stillframe::scenegraph::gl
