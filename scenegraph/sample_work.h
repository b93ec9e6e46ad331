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
  bool takes_early = false;  ///< `convert` waits for what it needs of the payload, and for its good end

  /// The product of one entry, put into the cache; made once, however many ask at a time. `message` keeps what it was
  /// made of: giving back large memory takes long, so whoever waits for the product is told before.
  [[nodiscard]] Loaded load(TopicId topic, const Entry& entry, EarlyObject& message) const {
    const auto fail = [&](StatusLevel level, const std::string& code, const std::string& reason) {
      return std::unexpected(
          Status{level, code, "'" + topic_name + "' at " + timeText(entry.log_time) + ": " + reason});
    };
    const CacheKey key = cacheKey(topic, entry, tag);
    const ObjectCache::Claim claim(dataset->cache(), key);
    if (auto made = dataset->cache().template peek<Product>(key)) {
      return made;  // by another layer's worker, meanwhile
    }
    if (auto early = makeEarly(topic, entry, message)) {
      dataset->cache().put(key, early, early->byteSize());
      return early;
    }
    auto decoded = dataset->store().decode(topic, entry);
    if (!decoded) {
      return fail(StatusLevel::Error, decoded.error().code, decoded.error().message);
    }
    message = {*std::move(decoded), nullptr};
    if (message.object.type() != type) {
      return fail(StatusLevel::Error, "WrongObject", "the decoder made another object than the topic announces");
    }
    const Precedence wanted;  // not while it is decoded: that may wait for a chunk that another thread unpacks
    auto converted = convert(message.object, entry);
    if (!converted) {
      return fail(converted.error().level, converted.error().code, converted.error().message);
    }
    auto product = std::make_shared<const Product>(std::move(*converted));
    dataset->cache().put(key, product, product->byteSize());
    return product;
  }
  /// While its payload is still being unpacked; nullptr where that cannot be, or fails: then load() says why.
  [[nodiscard]] std::shared_ptr<const Product> makeEarly(TopicId topic, const Entry& entry,
                                                         EarlyObject& message) const {
    auto early = takes_early ? dataset->store().decodeEarly(topic, entry) : std::nullopt;
    if (!early || early->object.type() != type) {
      return nullptr;
    }
    message = *std::move(early);
    const Precedence wanted;
    auto converted = convert(message.object, entry);
    return converted ? std::make_shared<const Product>(std::move(*converted)) : nullptr;
  }
  /// load() for who may want it later: what fails, fails again when it is wanted, and says so then.
  void tryLoad(TopicId topic, const Entry& entry) const noexcept {
    try {
      if (dataset->cache().template peek<Product>(cacheKey(topic, entry, tag)) == nullptr) {
        EarlyObject message;
        (void)load(topic, entry, message);
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
        EarlyObject message;
        product = load(topic, *entry, message).value_or(nullptr);
      }
      scan->product = product != nullptr && accept(*product) ? std::move(product) : nullptr;
    }
    return scan;
  }
};

/// load() for LatestJob, which lets go of the message when the product was told, and all else that waits is made.
template <typename Product>
[[nodiscard]] auto jobOf(std::shared_ptr<const SampleWork<Product>> work, TopicId topic, const Entry& entry) {
  return [work = std::move(work), topic, entry, message = std::make_shared<EarlyObject>()] {
    return work->load(topic, entry, *message);
  };
}

}  // namespace stillframe::scenegraph
