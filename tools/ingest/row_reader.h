#pragma once

#include <expected>
#include <memory>
#include <string>
#include <string_view>

#include "tools/ingest/message_decoder.h"
#include "tools/ingest/wire_shape.h"

namespace stillframe::ingest {

/// Fills rows from messages, whatever their encoding. Any thread.
class RowReader {
 public:
  /// What a filled row points into.
  struct Read {
    MessageView payloads;                  ///< the bytes of Bytes members are part of it; give it to payloadOf()
    std::shared_ptr<const void> lifetime;  ///< texts and bytes of the row are valid while it is held
  };
  virtual ~RowReader() = default;
  /// `row` is an object of the struct that the shape was made for.
  [[nodiscard]] virtual std::expected<Read, scenegraph::DecodeError> read(const MessageView& message,
                                                                          void* row) const = 0;
  /// As WirePlan::decodeEarly() has it; false for other encodings.
  [[nodiscard]] virtual bool readEarly(const MessageView& /*message*/, std::size_t /*there*/, void* /*row*/) const {
    return false;
  }
};

/// The reader of a schema by the encoding of the messages: "cdr" and "ros1" by the ROS definition, "protobuf" by the
/// descriptors of the schema, "json". The error is the reason why the channel cannot be drawn, half a sentence.
[[nodiscard]] std::expected<std::unique_ptr<RowReader>, std::string> makeRowReader(const SchemaRecord& schema,
                                                                                   std::string_view message_encoding,
                                                                                   const Shape& shape);

}  // namespace stillframe::ingest
