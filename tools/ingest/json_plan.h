#pragma once

#include <cstddef>
#include <expected>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scenegraph/store/object_store.h"
#include "tools/ingest/wire_shape.h"

namespace stillframe::ingest {

/// The way from a JSON message to the members of a row, by the names of the shape alone: schemas of JSON messages are
/// not looked at, and what a message lacks is 0 where its object is there, as with protobuf.
///
/// Bytes are base64; times are {sec, nsec} (or nanosec) or RFC 3339 text, durations also "1.5s"; numbers may be null,
/// "NaN", "Infinity" or "-Infinity". Any thread.
class JsonPlan {
 public:
  /// What a decoded row points into.
  struct Kept {
    std::shared_ptr<const void> texts;
    std::shared_ptr<const void> bytes;
    std::size_t byte_count = 0;
  };
  [[nodiscard]] static JsonPlan compile(const Shape& shape);
  /// Codes: "BadJson" (no JSON, or a value of another kind), "TooManyElements".
  [[nodiscard]] std::expected<Kept, scenegraph::DecodeError> decode(std::span<const std::byte> message,
                                                                    void* row) const;

 private:
  friend class JsonRunner;
  struct Field {
    std::vector<std::string> path;
    Shape::Binding binding;
    std::size_t target = 0;  ///< Row, Rows: index of its row
  };
  std::size_t add(const Shape& shape);

  std::vector<std::vector<Field>> rows_;
  std::size_t root_ = 0;
};

}  // namespace stillframe::ingest
