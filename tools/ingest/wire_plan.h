#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>
#include <string>
#include <vector>

#include "scenegraph/store/object_store.h"
#include "tools/ingest/message_definition.h"
#include "tools/ingest/wire_shape.h"

namespace stillframe::ingest {

/// The way through the bytes of one schema to the members of a row: compiled once per schema, then run per message.
///
/// Values that nobody wants are stepped over; texts and byte arrays come as views. A message costs about 2 ns per
/// field, and its work is bounded by its bytes however the schema lies. Any thread.
class WirePlan {
 public:
  /// The error is one sentence: a field of the shape that the definition lacks, or that has another type there.
  [[nodiscard]] static std::expected<WirePlan, std::string> compile(const MessageDefinitions& definitions,
                                                                    const Shape& shape);
  /// Fills `row`, an object of the struct the shape was made for, from a message: CDR with its encapsulation header for
  /// a ROS 2 definition, packed for a ROS 1 one. Codes: "TruncatedMessage", "BadEncapsulation",
  /// "TooManyElements".
  [[nodiscard]] std::expected<void, scenegraph::DecodeError> decode(std::span<const std::byte> message,
                                                                    void* row) const;
  /// The same of a message of which the first `there` bytes have arrived: whether they are enough for all but the
  /// content of byte arrays.
  [[nodiscard]] bool decodeEarly(std::span<const std::byte> message, std::size_t there, void* row) const;

 private:
  friend class PlanCompiler;
  friend struct PlanRunner;

  enum class OpKind : std::uint8_t {
    Skip,          ///< `size` bytes aligned to `alignment`
    SkipSequence,  ///< a count, then that many times `size` bytes
    SkipText,      ///< a count, then that many times `size` bytes, aligned only when there are some
    SkipMany,      ///< elements of plan `target`
    Number,        ///< a value of wire type `type` into the slot
    Numbers,       ///< many of them into a vector
    Text,
    Texts,
    Bytes,
    Stamp,
    Row,   ///< plan `target`, into the row that the slot is
    Rows,  ///< elements of plan `target`, one row each
  };
  struct Op {
    OpKind kind = OpKind::Skip;
    WireType type = WireType::Uint8;
    SlotKind slot = SlotKind::Double;
    std::uint8_t alignment = 1;
    bool is_sequence = false;  ///< `count` is read from the message
    std::uint32_t count = 1;
    std::uint64_t size = 0;
    std::size_t target = 0;
    void* (*locate)(void*) = nullptr;
    void* (*append)(void*, std::size_t) = nullptr;
    std::size_t row_bytes = 0;  ///< Rows: size of one
  };
  /// The steps of one message; names[i] is the field of ops[i].
  struct Steps {
    std::vector<Op> ops;
    std::vector<std::string> names;
    std::uint64_t min_bytes = 0;  ///< fewer than that no such message has
  };

  [[nodiscard]] std::expected<void, scenegraph::DecodeError> decode(std::span<const std::byte> message,
                                                                    std::size_t there, void* row) const;

  bool is_ros1_ = false;
  std::size_t root_ = 0;
  std::vector<Steps> steps_;
};

}  // namespace stillframe::ingest
