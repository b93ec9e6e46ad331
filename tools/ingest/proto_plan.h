#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/store/object_store.h"
#include "tools/ingest/wire_shape.h"

namespace stillframe::ingest {

/// The way through the bytes of a protobuf message to the members of a row: compiled once from the descriptors that the
/// schema carries (libprotobuf reads and checks them), then run per message.
///
/// The wire is walked here rather than through a DynamicMessage, because that copies every text and byte array and
/// makes an object of every point: here they stay views into the message, at any depth. Unknown fields are passed
/// over; numbers that the message leaves out are 0 where their message is there, as proto3 says. Any thread.
class ProtoPlan {
 public:
  /// `schema` is a FileDescriptorSet that holds the message `name`. The error is half a sentence.
  [[nodiscard]] static std::expected<ProtoPlan, std::string> compile(std::string_view schema, const std::string& name,
                                                                     const Shape& shape);
  /// Codes: "TruncatedMessage", "BadMessage" (not protobuf, or a field of another wire type), "TooManyElements".
  [[nodiscard]] std::expected<void, scenegraph::DecodeError> decode(std::span<const std::byte> message,
                                                                    void* row) const;

 private:
  friend class ProtoCompiler;
  friend class ProtoRunner;

  /// How a value lies on the wire, apart from its size.
  enum class Coding : std::uint8_t {
    Float,
    Double,
    Varint32,
    Varint64,
    Unsigned,
    ZigZag,
    Fixed32,
    Fixed64,
    Signed32,
    Signed64
  };
  enum class OpKind : std::uint8_t { Number, Numbers, Text, Texts, Bytes, Stamp, Inside, Row, Rows };
  struct Field {
    std::uint32_t number = 0;
    OpKind kind = OpKind::Number;
    Coding coding = Coding::Unsigned;
    SlotKind slot = SlotKind::Double;
    std::size_t target = 0;  ///< Inside (fields of the same row), Row, Rows: index of its message
    void* (*locate)(void*) = nullptr;
    void* (*append)(void*, std::size_t) = nullptr;
    std::size_t row_bytes = 0;
    std::string name;
  };
  using Message = std::vector<Field>;  // by number

  std::size_t root_ = 0;
  std::vector<Message> messages_;
};

}  // namespace stillframe::ingest
