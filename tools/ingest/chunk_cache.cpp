#include "tools/ingest/chunk_cache.h"

#include <exception>
#include <iterator>
#include <system_error>
#include <thread>
#include <utility>

#include "scenegraph/thread_priority.h"

namespace stillframe::ingest {

std::shared_ptr<ChunkCache::Slot> ChunkCache::slotOf(std::uint64_t key) {
  if (const auto known = index_.find(key); known != index_.end()) {
    items_.splice(items_.begin(), items_, known->second);
    return items_.front().slot;
  }
  // What somebody still reads is not unpacked anew; it stays with who does.
  if (const auto gone = let_go_.find(key); gone != let_go_.end()) {
    if (auto slot = gone->second.lock()) {
      return slot;
    }
    let_go_.erase(gone);
  }
  items_.push_front({key, std::make_shared<Slot>(), 0});
  index_[key] = items_.begin();
  return items_.front().slot;
}

void ChunkCache::letGo(std::list<Item>& items, std::list<Item>::iterator item) {
  std::erase_if(let_go_, [](const auto& entry) { return entry.second.expired(); });
  let_go_[item->key] = item->slot;
  bytes_ -= item->bytes;
  index_.erase(item->key);
  items.splice(items.begin(), items_, item);
}

std::shared_ptr<const ChunkCache::Chunk> ChunkCache::get(std::uint64_t key,
                                                         const std::function<Chunk(scenegraph::Arrival&)>& unpack) {
  std::shared_ptr<Slot> slot;
  {
    const std::lock_guard lock(mutex_);
    slot = slotOf(key);
  }
  return fill(slot, key, unpack);
}

std::optional<ChunkCache::Early> ChunkCache::getEarly(std::uint64_t key,
                                                      std::function<Chunk(scenegraph::Arrival&)> unpack) {
  std::shared_ptr<Slot> slot;
  {
    const std::lock_guard lock(mutex_);
    slot = slotOf(key);
  }
  Early early{{slot, &slot->arrival}, nullptr};
  if (!slot->is_begun.exchange(true)) {
    try {
      early.writer = std::make_shared<std::jthread>([this, slot, key, unpack = std::move(unpack)] {
        try {
          (void)fill(slot, key, unpack);
          // NOLINTNEXTLINE(bugprone-empty-catch): who asks for the whole chunk tries again, and is told
        } catch (const std::exception&) {
        }
      });
    } catch (const std::system_error&) {  // no thread left
      slot->is_begun = false;
      return std::nullopt;
    }
  }
  scenegraph::await(slot->is_awaited);
  return slot->arrival.block() ? std::optional(std::move(early)) : std::nullopt;
}

std::shared_ptr<const ChunkCache::Chunk> ChunkCache::fill(const std::shared_ptr<Slot>& slot, std::uint64_t key,
                                                          const std::function<Chunk(scenegraph::Arrival&)>& unpack) {
  scenegraph::await(slot->is_awaited);
  std::call_once(slot->once, [&] {
    slot->is_begun = true;
    const scenegraph::Errand errand(slot->is_awaited);
    try {
      slot->chunk = unpack(slot->arrival);
    } catch (...) {
      slot->gave_up = std::current_exception();  // who asks next tries anew
      forget(key, *slot);
      slot->arrival.finish(false);
      return;
    }
    slot->arrival.finish(slot->chunk.has_value());
    std::list<Item> evicted;  // destroyed after the lock: a chunk may be large
    const std::size_t bytes = slot->chunk ? slot->chunk->size : 0;
    const std::lock_guard lock(mutex_);
    if (const auto item = index_.find(key); item != index_.end() && item->second->slot == slot) {
      item->second->bytes = bytes;
      bytes_ += bytes;
    }
    while (bytes_ > max_bytes_ && items_.size() > 1) {
      letGo(evicted, std::prev(items_.end()));
    }
  });
  if (slot->gave_up) {
    std::rethrow_exception(slot->gave_up);
  }
  return {slot, &slot->chunk};
}

void ChunkCache::forget(std::uint64_t key, const Slot& slot) {
  std::list<Item> forgotten;
  const std::lock_guard lock(mutex_);
  if (const auto item = index_.find(key); item != index_.end() && item->second->slot.get() == &slot) {
    letGo(forgotten, item->second);
  }
  if (const auto gone = let_go_.find(key); gone != let_go_.end() && gone->second.lock().get() == &slot) {
    let_go_.erase(gone);
  }
}

void ChunkCache::drop(std::uint64_t key) {
  std::list<Item> dropped;  // destroyed after the lock: a chunk may be large
  const std::lock_guard lock(mutex_);
  if (const auto known = index_.find(key); known != index_.end()) {
    letGo(dropped, known->second);
  }
}

}  // namespace stillframe::ingest
