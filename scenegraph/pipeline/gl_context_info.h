#pragma once

#include <cstdint>
#include <expected>
#include <string>

#include "scenegraph/status.h"

namespace stillframe::scenegraph {

/// What the driver says of the context that is current, once it is known to be one we can draw with.
struct GlContextInfo {
  std::string vendor;
  std::string renderer;
  std::string version;
  int max_texture_size = 0;
  std::uint64_t max_buffer_texels = 0;  ///< of a texture buffer
  bool is_software = false;             ///< a CPU rasteriser: slow, but bit-identical from run to run
};

/// Checks the context that is current on this thread: OpenGL 4.5, compatibility profile.
///
/// Code "WrongOpenGl" says what was found and what to do. Offscreen and window contexts alike go through it, because a
/// core context makes OSG draw nothing without a word.
[[nodiscard]] std::expected<GlContextInfo, Status> inspectCurrentContext();

}  // namespace stillframe::scenegraph
