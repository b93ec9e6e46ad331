#include "tools/ingest/chunk_cache.h"

namespace stillframe::ingest {

std::shared_ptr<const ChunkCache::Chunk> ChunkCache::get(std::uint64_t key, const std::function<Chunk()>& unpack) {
  std::shared_ptr<Slot> slot;
  {
    const std::lock_guard lock(mutex_);
    const auto known = index_.find(key);
    if (known != index_.end()) {
      items_.splice(items_.begin(), items_, known->second);
    } else {
      items_.push_front({key, std::make_shared<Slot>(), 0});
      index_[key] = items_.begin();
    }
    slot = items_.front().slot;
  }
  std::call_once(slot->once, [&] {
    slot->chunk = unpack();
    const std::size_t bytes = slot->chunk ? slot->chunk->size : 0;
    const std::lock_guard lock(mutex_);
    if (const auto item = index_.find(key); item != index_.end() && item->second->slot == slot) {
      item->second->bytes = bytes;
      bytes_ += bytes;
    }
    while (bytes_ > max_bytes_ && items_.size() > 1) {
      bytes_ -= items_.back().bytes;
      index_.erase(items_.back().key);
      items_.pop_back();
    }
  });
  return {slot, &slot->chunk};
}

void ChunkCache::drop(std::uint64_t key) {
  std::list<Item> dropped;  // destroyed after the lock: a chunk may be large
  const std::lock_guard lock(mutex_);
  if (const auto known = index_.find(key); known != index_.end()) {
    bytes_ -= known->second->bytes;
    dropped.splice(dropped.begin(), items_, known->second);
    index_.erase(known);
  }
}

}  // namespace stillframe::ingest
