#pragma once

#include <cstddef>
#include <expected>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "scenegraph/objects/object.h"
#include "scenegraph/objects/payload.h"
#include "scenegraph/store/object_store.h"
#include "tf/time.h"
#include "tools/ingest/mcap_records.h"

namespace stillframe::ingest {

/// One serialised message and the block of memory it is a part of.
struct MessageView {
  std::span<const std::byte> data;
  std::shared_ptr<const void> anchor;  ///< keeps the block alive
  std::size_t anchored_bytes = 0;      ///< size of the block
  tf::TimePoint log_time;
  std::shared_ptr<const scenegraph::Arrival> arrival = nullptr;  ///< of the block, if that is still being written
  std::size_t place = 0;                                         ///< of `data` in the block, where that counts
};

/// Turns the messages of one schema into canonical objects. Any thread.
class MessageDecoder {
 public:
  virtual ~MessageDecoder() = default;
  [[nodiscard]] virtual std::expected<scenegraph::AnyObject, scenegraph::DecodeError> decode(
      const MessageView& message) const = 0;
  /// As scenegraph::EntrySource has it, of a message of which the first `there` bytes have arrived.
  [[nodiscard]] virtual std::optional<scenegraph::AnyObject> decodeEarly(const MessageView& /*message*/,
                                                                         std::size_t /*there*/) const {
    return std::nullopt;
  }
  [[nodiscard]] virtual bool decodesEarly() const noexcept { return false; }
};

/// What a channel of a recording is to us.
struct ChannelDecoder {
  scenegraph::ObjectType type = scenegraph::ObjectType::None;
  std::shared_ptr<const MessageDecoder> decoder;  ///< nullptr when type is None
  std::string unsupported_reason;                 ///< "" unless type is None
};

/// The decoder for messages of `schema` (nullptr: the channel has none) in `message_encoding` on `topic`. A schema that
/// nothing is drawn from costs one comparison of names: its definition is not even parsed.
[[nodiscard]] ChannelDecoder makeDecoder(const SchemaRecord* schema, std::string_view message_encoding,
                                         std::string_view topic);
/// Whether the topic decides what messages of that schema are: std_msgs/String is a robot on some.
[[nodiscard]] bool dependsOnTopic(const SchemaRecord& schema);

/// Bytes of a message as a payload: a view, or a copy where the view would keep alive more than eight times its size
/// (the object cache counts the view); always a view while the message is still being written.
[[nodiscard]] scenegraph::Payload payloadOf(std::span<const std::byte> bytes, const MessageView& message);

}  // namespace stillframe::ingest
