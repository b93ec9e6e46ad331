#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "scenegraph/objects/arrival.h"

namespace stillframe::scenegraph {

/// Bytes that somebody else owns, with the anchor that keeps them alive. Copying it copies no bytes.
struct Payload {
  std::span<const std::byte> bytes;
  std::shared_ptr<const void> anchor;
  /// Of the block that the bytes are a part of, as long as they are still being written: only in an object of
  /// EntrySource::decodeEarly(). nullptr: all are there.
  std::shared_ptr<const Arrival> arrival = nullptr;
  std::size_t place = 0;  ///< of the first of them in that block
};

}  // namespace stillframe::scenegraph
