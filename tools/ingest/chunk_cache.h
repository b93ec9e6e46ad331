#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <expected>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

#include "scenegraph/objects/arrival.h"
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
  /// The chunk of that key; `unpack` makes it when it is not there, and tells of what it has so far. Blocks while
  /// another thread makes it, which does not stand back any longer then.
  [[nodiscard]] std::shared_ptr<const Chunk> get(std::uint64_t key,
                                                 const std::function<Chunk(scenegraph::Arrival&)>& unpack);
  /// A chunk that is still being unpacked.
  struct Early {
    std::shared_ptr<const scenegraph::Arrival> arrival;
    std::shared_ptr<void> writer;  ///< waits for its end when let go of, if nobody else unpacked it
  };
  /// The chunk while it is being unpacked: by another thread already, or by one of its own from now on. nullopt when
  /// it is there, or cannot be unpacked. This must outlive what it gives.
  [[nodiscard]] std::optional<Early> getEarly(std::uint64_t key, std::function<Chunk(scenegraph::Arrival&)> unpack);
  /// The chunk is not wanted again soon.
  void drop(std::uint64_t key);

 private:
  struct Slot {
    std::once_flag once;
    std::atomic<bool> is_begun = false;
    std::atomic<bool> is_awaited = false;
    scenegraph::Arrival arrival;
    Chunk chunk;
    std::exception_ptr gave_up;  // what `unpack` threw instead
  };
  struct Item {
    std::uint64_t key = 0;
    std::shared_ptr<Slot> slot;
    std::size_t bytes = 0;
  };

  [[nodiscard]] std::shared_ptr<const Chunk> fill(const std::shared_ptr<Slot>& slot, std::uint64_t key,
                                                  const std::function<Chunk(scenegraph::Arrival&)>& unpack);
  void forget(std::uint64_t key, const Slot& slot);
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
