#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "tools/ingest/compression.h"

namespace stillframe::ingest {

/// Makes buffers, large ones of the memory of those that were let go of: the first touch of fresh memory takes as long
/// as unpacking into it, and giving it back to the system some milliseconds more. Keeps 64 MiB for that at most. Any
/// thread; owned by a shared_ptr, which its buffers share.
class BufferShelf : public std::enable_shared_from_this<BufferShelf> {
 public:
  static constexpr std::size_t kLarge = std::size_t{4} << 20;
  static constexpr std::size_t kMostBytes = std::size_t{64} << 20;

  /// As makeBuffer() makes it. Memory of up to twice that size is used for it.
  [[nodiscard]] Buffer take(std::size_t size);

 private:
  struct Block {
    std::unique_ptr<std::byte[]> bytes;
    std::size_t size = 0;
  };

  void keep(Block block);

  std::mutex mutex_;           // guards what follows
  std::vector<Block> blocks_;  // oldest first
  std::size_t bytes_ = 0;
};

}  // namespace stillframe::ingest
