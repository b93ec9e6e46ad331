#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <expected>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "scenegraph/status.h"
#include "scenegraph/store/dataset.h"
#include "scenegraph/store/tf_clock.h"
#include "scenegraph/thread_priority.h"

namespace stillframe::scenegraph {

/// How far the search for a reference sample has looked.
template <typename Product>
struct SampleScan {
  std::size_t looked = 0;  ///< entries from the front
  std::uint64_t last_sequence = 0;
  std::shared_ptr<const Product> product;
};

/// What SampleLoader's workers run: decode, convert, cache. Any thread; immutable.
template <typename Product>
struct SampleWork {
  using Loaded = std::expected<std::shared_ptr<const Product>, Status>;

  std::shared_ptr<Dataset> dataset;
  ObjectType type;
  std::string topic_name;
  std::string tag;
  std::function<std::expected<Product, Status>(const AnyObject&, const Entry&)> convert;

  /// The product of one entry, put into the cache; made once, however many ask at a time.
  [[nodiscard]] Loaded load(TopicId topic, const Entry& entry) const {
    const auto fail = [&](StatusLevel level, const std::string& code, const std::string& message) {
      return std::unexpected(
          Status{level, code, "'" + topic_name + "' at " + timeText(entry.log_time) + ": " + message});
    };
    const CacheKey key = cacheKey(topic, entry, tag);
    const ObjectCache::Claim claim(dataset->cache(), key);
    if (auto made = dataset->cache().template peek<Product>(key)) {
      return made;  // by another layer's worker, meanwhile
    }
    const auto object = dataset->store().decode(topic, entry);
    if (!object) {
      return fail(StatusLevel::Error, object.error().code, object.error().message);
    }
    if (object->type() != type) {
      return fail(StatusLevel::Error, "WrongObject", "the decoder made another object than the topic announces");
    }
    const Precedence wanted;  // not while it is decoded: that may wait for a chunk that another thread unpacks
    auto converted = convert(*object, entry);
    if (!converted) {
      return fail(converted.error().level, converted.error().code, converted.error().message);
    }
    auto product = std::make_shared<const Product>(std::move(*converted));
    dataset->cache().put(key, product, product->byteSize());
    return product;
  }
  /// load() for who may want it later: what fails, fails again when it is wanted, and says so then.
  void tryLoad(TopicId topic, const Entry& entry) const noexcept {
    try {
      if (dataset->cache().template peek<Product>(cacheKey(topic, entry, tag)) == nullptr) {
        (void)load(topic, entry);
      }
      // NOLINTNEXTLINE(bugprone-empty-catch): who asks for it in earnest is told
    } catch (const std::exception&) {
    }
  }
  /// The first product from entry `first` on, before entry `count`, that `accept` takes.
  [[nodiscard]] std::expected<std::shared_ptr<const SampleScan<Product>>, Status> scan(
      TopicId topic, std::size_t first, std::size_t count, const std::function<bool(const Product&)>& accept) const {
    auto scan = std::make_shared<SampleScan<Product>>();
    scan->looked = first;
    while (scan->looked < count && scan->product == nullptr) {
      const auto entry = dataset->store().at(topic, scan->looked);
      if (!entry) {
        break;
      }
      ++scan->looked;
      scan->last_sequence = entry->sequence;
      auto product = dataset->cache().template get<Product>(cacheKey(topic, *entry, tag));
      if (product == nullptr) {
        product = load(topic, *entry).value_or(nullptr);
      }
      scan->product = product != nullptr && accept(*product) ? std::move(product) : nullptr;
    }
    return scan;
  }
};

}  // namespace stillframe::scenegraph
