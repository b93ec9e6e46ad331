#include "scenegraph/store/object_cache.h"

#include <functional>
#include <utility>

namespace stillframe::scenegraph {

CacheKey cacheKey(TopicId topic, const Entry& entry, std::string product) {
  return {topic, entry.log_time.ns, entry.payload_bytes, entry.sequence, std::move(product)};
}

ObjectCache::ObjectCache(std::size_t max_bytes) : max_bytes_(max_bytes) {}

std::size_t CacheKeyHash::operator()(const CacheKey& key) const noexcept {
  std::size_t hash = std::hash<std::string>{}(key.product);
  for (const std::uint64_t part :
       {std::uint64_t{key.topic}, static_cast<std::uint64_t>(key.log_time_ns), key.payload_bytes, key.sequence}) {
    hash = (hash ^ (part + 0x9e3779b97f4a7c15U + (hash << 6U) + (hash >> 2U))) * 0xff51afd7ed558ccdU;
  }
  return hash;
}

std::shared_ptr<const void> ObjectCache::find(const CacheKey& key) {
  const std::scoped_lock lock(mutex_);
  const auto found = index_.find(key);
  if (found == index_.end()) {
    ++misses_;
    return nullptr;
  }
  ++hits_;
  items_.splice(items_.begin(), items_, found->second);
  return found->second->product;
}

std::shared_ptr<const void> ObjectCache::findUncounted(const CacheKey& key) {
  const std::scoped_lock lock(mutex_);
  const auto found = index_.find(key);
  return found == index_.end() ? nullptr : found->second->product;
}

ObjectCache::Claim::Claim(ObjectCache& cache, CacheKey key) : cache_(cache), key_(std::move(key)) {
  std::unique_lock lock(cache_.mutex_);
  cache_.released_.wait(lock, [this] {
    const auto other = cache_.claimed_.find(key_);
    if (other != cache_.claimed_.end()) {
      await(other->second);
    }
    return other == cache_.claimed_.end();
  });
  errand_.emplace(cache_.claimed_.try_emplace(key_, false).first->second);
}

ObjectCache::Claim::~Claim() {
  errand_.reset();
  {
    const std::scoped_lock lock(cache_.mutex_);
    cache_.claimed_.erase(key_);
  }
  cache_.released_.notify_all();
}

void ObjectCache::put(const CacheKey& key, std::shared_ptr<const void> product, std::size_t bytes) {
  std::list<Item> dropped;  // destroyed after the lock: a product may be large
  const std::scoped_lock lock(mutex_);
  if (const auto found = index_.find(key); found != index_.end()) {
    bytes_ -= found->second->bytes;
    dropped.splice(dropped.begin(), items_, found->second);
    index_.erase(found);
  }
  if (bytes > max_bytes_) {
    return;
  }
  items_.push_front({key, std::move(product), bytes});
  index_[key] = items_.begin();
  bytes_ += bytes;
  evict(dropped);
}

void ObjectCache::setMaxBytes(std::size_t max_bytes) {
  std::list<Item> dropped;
  const std::scoped_lock lock(mutex_);
  max_bytes_ = max_bytes;
  evict(dropped);
}

void ObjectCache::evict(std::list<Item>& dropped) {
  while (bytes_ > max_bytes_) {
    const auto last = std::prev(items_.end());
    bytes_ -= last->bytes;
    index_.erase(last->key);
    dropped.splice(dropped.begin(), items_, last);
  }
}

std::size_t ObjectCache::maxBytes() const {
  const std::scoped_lock lock(mutex_);
  return max_bytes_;
}

std::size_t ObjectCache::bytes() const {
  const std::scoped_lock lock(mutex_);
  return bytes_;
}

std::uint64_t ObjectCache::hits() const {
  const std::scoped_lock lock(mutex_);
  return hits_;
}

std::uint64_t ObjectCache::misses() const {
  const std::scoped_lock lock(mutex_);
  return misses_;
}

}  // namespace stillframe::scenegraph
