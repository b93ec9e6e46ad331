#pragma once

#include <expected>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "tools/ingest/row_reader.h"

namespace stillframe::ingest {

/// A decoder made of a shape, filled from the message, and a function that turns the filled row into an object.
template <typename Row>
class RowDecoder final : public MessageDecoder {
 public:
  using Result = std::expected<scenegraph::AnyObject, scenegraph::DecodeError>;
  /// May take the row apart; `payloads` goes with its Bytes members to payloadOf().
  using Convert = Result (*)(Row& row, const MessageView& payloads);

  [[nodiscard]] static std::expected<std::unique_ptr<MessageDecoder>, std::string> create(
      const SchemaRecord& schema, std::string_view message_encoding, const Shape& shape, Convert convert) {
    auto reader = makeRowReader(schema, message_encoding, shape);
    if (!reader) {
      return std::unexpected(std::move(reader).error());
    }
    return std::unique_ptr<MessageDecoder>(new RowDecoder(*std::move(reader), convert));
  }
  [[nodiscard]] Result decode(const MessageView& message) const override {
    Row row;
    const auto read = reader_->read(message, &row);
    if (!read) {
      return std::unexpected(read.error());
    }
    return convert_(row, read->payloads);
  }

 private:
  RowDecoder(std::unique_ptr<RowReader> reader, Convert convert) : reader_(std::move(reader)), convert_(convert) {}

  std::unique_ptr<RowReader> reader_;
  Convert convert_;
};

}  // namespace stillframe::ingest
