#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace stillframe::scenegraph {

/// Bytes that somebody else owns, with the anchor that keeps them alive. Copying it copies no bytes.
struct Payload {
  std::span<const std::byte> bytes;
  std::shared_ptr<const void> anchor;
};

}  // namespace stillframe::scenegraph
