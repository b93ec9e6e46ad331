#pragma once

#include <cstdint>
#include <string>

#include "scenegraph/status.h"

namespace stillframe::nodes {

/// Why nothing is drawn of `what` ("'/topic' at 1 s: its 512 voxels"), which needs a larger texture buffer than the
/// driver takes (scenegraph::Tick::buffer_texels).
[[nodiscard]] inline scenegraph::Status bufferTooLarge(const std::string& what, std::uint64_t needed_texels,
                                                       std::uint64_t taken_texels) {
  return {scenegraph::StatusLevel::Error, "BufferTooLarge",
          what + " need a buffer of " + std::to_string(needed_texels) + " texels; this OpenGL driver takes " +
              std::to_string(taken_texels)};
}

}  // namespace stillframe::nodes
