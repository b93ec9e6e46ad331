#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

#include "scenegraph/store/object_store.h"
#include "scenegraph/thread_priority.h"

namespace stillframe::scenegraph {

/// Names one product of one entry: the decoded object ("object"), or what a layer made of it ("points").
struct CacheKey {
  TopicId topic = 0;
  std::int64_t log_time_ns = 0;
  std::uint64_t payload_bytes = 0;
  std::uint64_t sequence = 0;
  std::string product = "object";  ///< with every setting that changes the product's bytes

  friend bool operator==(const CacheKey&, const CacheKey&) = default;
};

struct CacheKeyHash {
  std::size_t operator()(const CacheKey& key) const noexcept;
};

[[nodiscard]] CacheKey cacheKey(TopicId topic, const Entry& entry, std::string product = "object");

/// Least-recently-used products within a bound in bytes, shared by all views of a dataset. Any thread.
///
/// A product in use stays alive through its shared_ptr when it is evicted. One larger than the whole bound is not kept.
class ObjectCache {
 public:
  explicit ObjectCache(std::size_t max_bytes = std::size_t{1} << 30);

  /// The product, marked as just used; nullptr when absent. T must be what put() stored under this key.
  template <typename T>
  [[nodiscard]] std::shared_ptr<const T> get(const CacheKey& key) {
    return std::static_pointer_cast<const T>(find(key));
  }
  /// get(), uncounted: for whoever has claimed the key.
  template <typename T>
  [[nodiscard]] std::shared_ptr<const T> peek(const CacheKey& key) {
    return std::static_pointer_cast<const T>(findUncounted(key));
  }
  /// The right to make the product of a key, held until it is destroyed. Who asks meanwhile, for a second layer or view
  /// of the same topic, waits, and then finds the product by peek(); whose work it is does not stand back any longer
  /// then. Of the thread that makes it. Not from within the work of another claim.
  class Claim {
   public:
    Claim(ObjectCache& cache, CacheKey key);
    ~Claim();
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;

   private:
    ObjectCache& cache_;
    CacheKey key_;
    std::optional<Errand> errand_;
  };
  /// Keeps a product; replaces an older one of the same key.
  void put(const CacheKey& key, std::shared_ptr<const void> product, std::size_t bytes);
  void setMaxBytes(std::size_t max_bytes);
  [[nodiscard]] std::size_t maxBytes() const;
  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] std::uint64_t hits() const;
  [[nodiscard]] std::uint64_t misses() const;

 private:
  struct Item {
    CacheKey key;
    std::shared_ptr<const void> product;
    std::size_t bytes = 0;
  };
  std::shared_ptr<const void> find(const CacheKey& key);
  std::shared_ptr<const void> findUncounted(const CacheKey& key);
  void evict(std::list<Item>& dropped);  // moves what is over the bound to `dropped`

  mutable std::mutex mutex_;  // guards everything below
  std::list<Item> items_;     // front = most recently used
  std::unordered_map<CacheKey, std::list<Item>::iterator, CacheKeyHash> index_;
  std::size_t bytes_ = 0;
  std::size_t max_bytes_;
  std::uint64_t hits_ = 0;
  std::uint64_t misses_ = 0;
  std::unordered_map<CacheKey, std::atomic<bool>, CacheKeyHash> claimed_;  // whether it is awaited
  std::condition_variable released_;                                       // a key of claimed_
};

}  // namespace stillframe::scenegraph
