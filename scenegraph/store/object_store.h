#pragma once

#include <atomic>
#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <shared_mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenegraph/objects/object.h"
#include "tf/time.h"

namespace stillframe::scenegraph {

/// Dense index of a topic in its store.
using TopicId = std::uint32_t;

/// A message that could not become a canonical object.
struct DecodeError {
  std::string code;     ///< "TruncatedMessage", "BadDefinition", "BadChunk", ... as in Status
  std::string message;  ///< one sentence with byte counts, field or reason; the topic and time are added by the reader
};

/// Where one message is; 32 bytes, so that an index of a long recording stays small.
struct Entry {
  tf::TimePoint log_time;           ///< ingest time: the tracker's clock
  std::uint64_t payload_bytes = 0;  ///< serialised size
  std::uint64_t locator = 0;        ///< means something to the EntrySource only
  std::uint64_t sequence = 0;       ///< order of arrival in the store; breaks ties of log_time
};

struct TopicInfo;

/// An object whose payload is still being written.
struct EarlyObject {
  AnyObject object;
  std::shared_ptr<void> writer;  ///< waits for it, where that is a thread of its own, when let go of
};

/// Turns entries into objects. Called from any thread, several at a time.
class EntrySource {
 public:
  virtual ~EntrySource() = default;
  [[nodiscard]] virtual std::expected<AnyObject, DecodeError> decode(const TopicInfo& topic,
                                                                     const Entry& entry) const = 0;
  /// What decode() will make, before all of its payload is there: for whoever goes through that from its beginning,
  /// and waits for it by Payload::arrival. nullopt where decode() is as well, or there is anything to be said.
  /// It must outlive the writer.
  [[nodiscard]] virtual std::optional<EarlyObject> decodeEarly(const TopicInfo& /*topic*/,
                                                               const Entry& /*entry*/) const {
    return std::nullopt;
  }
};

/// What a store knows of a topic. Topics of an unknown schema are listed too, with type None and a reason.
struct TopicInfo {
  std::string name;
  ObjectType type = ObjectType::None;
  std::string schema;              ///< as in the file, "sensor_msgs/msg/PointCloud2"
  std::string encoding;            ///< message encoding: "cdr", "ros1", "protobuf", "json"
  std::string unsupported_reason;  ///< why type is None; "" otherwise
  bool is_static = false;          ///< a latched transform topic (its name ends in "tf_static")
};

/// Entries of all topics of a dataset by log time, decoded lazily.
///
/// One writer (the loader) and many readers, without outside locking. Lookups cost O(log entries) and do not depend on
/// the position. Topics are only ever added.
class ObjectStore {
 public:
  /// Adds a topic whose messages `source` decodes; a topic of the same name and type is reused, with the source it has.
  TopicId addTopic(TopicInfo info, std::shared_ptr<const EntrySource> source);
  /// Adds entries in any order; `sequence` is assigned here. O(1) an entry at the end, one merge a batch elsewhere.
  /// Listeners hear of it after the lock is released.
  void append(TopicId topic, std::span<const Entry> entries);

  [[nodiscard]] std::size_t topicCount() const;
  [[nodiscard]] TopicInfo topic(TopicId topic) const;
  /// The first topic of that name, or of that name and type.
  [[nodiscard]] std::optional<TopicId> findTopic(std::string_view name, std::optional<ObjectType> type = {}) const;
  [[nodiscard]] std::size_t entryCount(TopicId topic) const;
  /// Newest entry with log_time <= t; the last to arrive when several share it.
  [[nodiscard]] std::optional<Entry> newestAtOrBefore(TopicId topic, tf::TimePoint t) const;
  /// How many entries have log_time <= t: the position of the first later one.
  [[nodiscard]] std::size_t countAtOrBefore(TopicId topic, tf::TimePoint t) const;
  /// All entries in (after, upto], oldest first. `after` absent: from the beginning.
  [[nodiscard]] std::vector<Entry> range(TopicId topic, std::optional<tf::TimePoint> after, tf::TimePoint upto) const;
  /// Entry by position in time order; nullopt past the end.
  [[nodiscard]] std::optional<Entry> at(TopicId topic, std::size_t index) const;
  /// Entries with that sequence or a later one, in time order: what is new to a reader with a cursor.
  [[nodiscard]] std::vector<Entry> arrivedSince(TopicId topic, std::uint64_t sequence) const;
  /// First and last log time over the topic; nullopt when empty.
  [[nodiscard]] std::optional<std::pair<tf::TimePoint, tf::TimePoint>> span(TopicId topic) const;

  /// Decodes without a cache; ObjectCache is the way for layers. May block on the disk.
  [[nodiscard]] std::expected<AnyObject, DecodeError> decode(TopicId topic, const Entry& entry) const;
  /// As EntrySource has it; what it gives keeps the source.
  [[nodiscard]] std::optional<EarlyObject> decodeEarly(TopicId topic, const Entry& entry) const;

  /// Counts appends and new topics: equal revisions mean equal content.
  [[nodiscard]] std::uint64_t revision() const noexcept;
  /// Told on the writer's thread what grew (the topic); returns a token that ends it when destroyed. A call that is
  /// under way on the writer's thread just then may still finish.
  [[nodiscard]] std::shared_ptr<void> listen(std::function<void(TopicId)> listener);

 private:
  struct TopicData {
    std::shared_ptr<const TopicInfo> info;
    std::shared_ptr<const EntrySource> source;
    std::vector<Entry> entries;  // sorted by (log_time, sequence)
    bool is_in_arrival_order;    // then sorted by sequence as well
  };
  void notify(TopicId topic);
  [[nodiscard]] std::pair<std::shared_ptr<const TopicInfo>, std::shared_ptr<const EntrySource>> decoderOf(
      TopicId topic) const;

  mutable std::shared_mutex mutex_;  // guards topics_, listeners_, next_sequence_
  std::vector<TopicData> topics_;
  std::vector<std::weak_ptr<std::function<void(TopicId)>>> listeners_;
  std::uint64_t next_sequence_ = 0;
  std::atomic<std::uint64_t> revision_ = 0;
};

}  // namespace stillframe::scenegraph
