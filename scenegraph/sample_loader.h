#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "scenegraph/latest_job.h"
#include "scenegraph/layer.h"
#include "scenegraph/read_ahead.h"
#include "scenegraph/sample_work.h"
#include "scenegraph/status.h"
#include "scenegraph/store/dataset.h"
#include "scenegraph/store/tf_clock.h"

namespace stillframe::scenegraph {

/// Brings the sample of a topic that is in force at a tick to the form a layer draws, off the GUI thread.
///
/// The one decoding pattern of all layers (REQUIREMENTS C3): product in the cache? else decode, convert and cache it on
/// the executor, latest wins; a tick that resolves to the sample already shown does nothing; a failed sample clears the
/// view and is never tried again. While a sample is under way the one before stays, and status() says so. Where the
/// executor has time to spare, the sample that comes next in the direction of play is made ready.
///
/// ```cpp
/// loader_.emplace(context, ObjectType::PointCloud, topic_, "points", [](const AnyObject& object, const Entry&) {
///   return convertCloud(*object.get<PointCloud>());  // std::expected<CloudPoints, Status>; never null here
/// });
/// if (loader_->update(tick.time)) { rebuildFrom(loader_->product()); }  // nullptr: draw nothing, status() says why
/// ```
/// Product has `std::size_t byteSize() const`. GUI thread only; the dataset must be owned by a shared_ptr. `convert`
/// runs on a worker and may outlive the loader: it captures values only.
template <typename Product>
class SampleLoader {
 public:
  using Convert = std::function<std::expected<Product, Status>(const AnyObject&, const Entry&)>;
  using IsReference = std::function<bool(const Product&)>;

  /// `tag` names the product in the cache, with every setting that changes its bytes ("points"). `is_reference`: which
  /// samples reference() accepts. `takes_early`: as SampleWork has it.
  SampleLoader(
      const LayerContext& context, ObjectType type, std::string topic, std::string tag, Convert convert,
      IsReference is_reference = [](const Product&) { return true; }, bool takes_early = false)
      : topic_name_(std::move(topic)),
        shared_(std::make_shared<const Shared>(Shared{context.dataset.shared_from_this(), type, topic_name_,
                                                      std::move(tag), std::move(convert), takes_early})),
        is_reference_(std::move(is_reference)),
        ahead_(context.executor),
        sample_job_(context.executor, context.request_update),
        reference_job_(context.executor, context.request_update) {}

  /// Moves to the newest sample at or before `time`. Returns whether product(), entry() or status() changed.
  bool update(tf::TimePoint time) {
    const auto entry = entryAt(time);
    if (!entry) {
      sample_job_.cancel();
      ahead_.forget();
      return show(std::nullopt, nullptr, noMessage(time));
    }
    const CacheKey key = cacheKey(*topic_, *entry, shared_->tag);
    if (shown_key_ == key) {
      sample_job_.cancel();
      return show(entry, product_, shown_status_);
    }
    auto product = shared_->dataset->cache().template get<Product>(key);
    if (product == nullptr) {
      sample_job_.request(key, jobOf<Product>(shared_, *topic_, *entry));
      auto outcome = sample_job_.take();
      if (!outcome) {
        return show(entry_, product_, decoding(*entry));
      }
      if (!outcome->result) {
        shown_key_ = key;
        shown_status_ = outcome->result.error();
        return show(entry, nullptr, shown_status_);
      }
      product = *outcome->result;
    } else {
      sample_job_.cancel();
    }
    shown_key_ = key;
    shown_status_ = {};
    readAhead(*entry, product->byteSize());
    return show(entry, std::move(product), {});
  }

  /// What to draw; nullptr when there is nothing.
  [[nodiscard]] const std::shared_ptr<const Product>& product() const noexcept { return product_; }
  /// The sample that product() or a failed status() is about.
  [[nodiscard]] const std::optional<Entry>& entry() const noexcept { return entry_; }
  /// Ok; NoTopic, NoMessage; Decoding (the sample before is still shown); or why the sample could not be decoded.
  [[nodiscard]] const Status& status() const noexcept { return status_; }
  [[nodiscard]] bool isPending() const { return sample_job_.isPending() || reference_job_.isPending(); }

  /// The first sample of the topic, by time, that can be decoded and that `is_reference` accepts: what colour ranges
  /// held across scrubbing come from, whichever sample was visited first. nullptr while it is under way or when there
  /// is none; asked for on the first call and again when the topic has grown at its front.
  [[nodiscard]] std::shared_ptr<const Product> reference() {
    if (!findTopic()) {
      return nullptr;
    }
    const std::size_t count = shared_->dataset->store().entryCount(*topic_);
    if (scan_ && scan_->looked > 0) {
      const auto last = shared_->dataset->store().at(*topic_, scan_->looked - 1);
      if (!last || last->sequence != scan_->last_sequence) {
        scan_.reset();
      }
    }
    if (count > 0 && (!scan_ || (scan_->product == nullptr && scan_->looked < count))) {
      const std::size_t first = scan_ ? scan_->looked : 0;
      const auto last = shared_->dataset->store().at(*topic_, count - 1);
      CacheKey key{*topic_, static_cast<std::int64_t>(first), count, last->sequence, "reference"};
      reference_job_.request(key, [shared = shared_, topic = *topic_, first, count, accept = is_reference_] {
        return shared->scan(topic, first, count, accept);
      });
      if (auto outcome = reference_job_.take(); outcome && outcome->result) {
        scan_ = **outcome->result;
      }
    }
    return scan_ ? scan_->product : nullptr;
  }

 private:
  using Scan = SampleScan<Product>;
  using Shared = SampleWork<Product>;

  bool findTopic() {
    if (!topic_) {
      topic_ = shared_->dataset->store().findTopic(topic_name_, shared_->type);
    }
    return topic_.has_value();
  }
  std::optional<Entry> entryAt(tf::TimePoint time) {
    return findTopic() ? shared_->dataset->store().newestAtOrBefore(*topic_, time) : std::nullopt;
  }
  void readAhead(const Entry& shown, std::size_t bytes) {
    constexpr std::size_t kOfAKind = 4;  // ahead, shown, shown before, reference
    const ObjectStore& store = shared_->dataset->store();
    const auto place = static_cast<std::int64_t>(store.countAtOrBefore(*topic_, shown.log_time)) - 1;
    const std::int64_t next = placeAhead(std::exchange(place_, place).value_or(place), place);
    const bool has_room = bytes <= shared_->dataset->cache().maxBytes() / kOfAKind;
    const auto entry = next >= 0 && has_room ? store.at(*topic_, static_cast<std::size_t>(next)) : std::nullopt;
    if (!entry) {
      return ahead_.forget();
    }
    ahead_.request(cacheKey(*topic_, *entry, shared_->tag),
                   [shared = shared_, topic = *topic_, entry = *entry] { shared->tryLoad(topic, entry); });
  }
  [[nodiscard]] Status noMessage(tf::TimePoint time) const {
    if (!topic_) {
      return {StatusLevel::Warn, "NoTopic",
              "there is no topic '" + topic_name_ + "' of type " + std::string(toString(shared_->type))};
    }
    const auto span = shared_->dataset->store().span(*topic_);
    return {StatusLevel::Warn, "NoMessage",
            span ? "no message on '" + topic_name_ + "' at or before " + timeText(time) + ": the first is at " +
                       timeText(span->first)
                 : "no message on '" + topic_name_ + "'"};
  }
  [[nodiscard]] Status decoding(const Entry& entry) const {
    return {StatusLevel::Warn, "Decoding",
            "the message of " + timeText(entry.log_time) + " on '" + topic_name_ + "' is being decoded" +
                (product_ != nullptr ? "; the one of " + timeText(entry_->log_time) + " is shown meanwhile" : "")};
  }
  bool show(std::optional<Entry> entry, std::shared_ptr<const Product> product, Status status) {
    const auto sequence = [](const std::optional<Entry>& of) {
      return of ? std::optional(of->sequence) : std::nullopt;
    };
    const bool has_changed = product != product_ || sequence(entry) != sequence(entry_) || status != status_;
    if (!entry) {
      shown_key_.reset();
    }
    entry_ = entry;
    product_ = std::move(product);
    status_ = std::move(status);
    return has_changed;
  }

  std::string topic_name_;
  std::shared_ptr<const Shared> shared_;
  IsReference is_reference_;
  std::optional<TopicId> topic_;
  std::optional<CacheKey> shown_key_;  // of what product_ or a failure is about
  Status shown_status_;                // that went with it
  std::optional<Entry> entry_;
  std::shared_ptr<const Product> product_;
  Status status_{StatusLevel::Warn, "NoMessage", ""};
  std::optional<Scan> scan_;
  std::optional<std::int64_t> place_;  // of what was shown last, among the entries of the topic
  ReadAhead ahead_;
  LatestJob<Product> sample_job_;
  LatestJob<Scan> reference_job_;
};

}  // namespace stillframe::scenegraph
