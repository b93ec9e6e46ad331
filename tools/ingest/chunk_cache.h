#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

#include "tools/ingest/compression.h"

namespace stillframe::ingest {

/// The chunks unpacked last, within a bound in bytes. Any thread; a chunk that several want at once is unpacked once.
///
/// A chunk in use lives on after it was evicted or dropped, and is found as long as it does. A chunk that could not be
/// unpacked is remembered as such.
class ChunkCache {
 public:
  using Chunk = std::expected<Buffer, std::string>;

  explicit ChunkCache(std::size_t max_bytes) : max_bytes_(max_bytes) {}
  /// The chunk of that key; `unpack` makes it when it is not there. Blocks while another thread makes it, which does
  /// not stand back any longer then.
  [[nodiscard]] std::shared_ptr<const Chunk> get(std::uint64_t key, const std::function<Chunk()>& unpack);
  /// The chunk is not wanted again soon.
  void drop(std::uint64_t key);

 private:
  struct Slot {
    std::once_flag once;
    std::atomic<bool> is_awaited = false;
    Chunk chunk;
  };
  struct Item {
    std::uint64_t key = 0;
    std::shared_ptr<Slot> slot;
    std::size_t bytes = 0;
  };

  /// With the lock held.
  [[nodiscard]] std::shared_ptr<Slot> slotOf(std::uint64_t key);
  void letGo(std::list<Item>& items, std::list<Item>::iterator item);

  std::mutex mutex_;       // guards everything below
  std::list<Item> items_;  // front = most recently used
  std::unordered_map<std::uint64_t, std::list<Item>::iterator> index_;
  std::unordered_map<std::uint64_t, std::weak_ptr<Slot>> let_go_;  // may still be in use
  std::size_t bytes_ = 0;
  std::size_t max_bytes_;
};

}  // namespace stillframe::ingest
