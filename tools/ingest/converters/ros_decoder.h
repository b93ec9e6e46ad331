#pragma once

#include <expected>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "tools/ingest/message_decoder.h"
#include "tools/ingest/wire_plan.h"

namespace stillframe::ingest {

/// The plan for a ROS schema: "cdr" messages with a "ros2msg" definition, "ros1" with "ros1msg". The error is the
/// reason why the channel cannot be drawn.
[[nodiscard]] std::expected<WirePlan, std::string> compileRosPlan(const SchemaRecord& schema,
                                                                  std::string_view message_encoding,
                                                                  const Shape& shape);

/// A decoder made of a shape, filled from the bytes, and a function that turns the filled row into an object.
template <typename Row>
class RosDecoder final : public MessageDecoder {
 public:
  using Convert = scenegraph::AnyObject (*)(const Row& row, const MessageView& message);

  [[nodiscard]] static std::expected<std::unique_ptr<MessageDecoder>, std::string> create(
      const SchemaRecord& schema, std::string_view message_encoding, const Shape& shape, Convert convert) {
    auto plan = compileRosPlan(schema, message_encoding, shape);
    if (!plan) {
      return std::unexpected(std::move(plan).error());
    }
    return std::unique_ptr<MessageDecoder>(new RosDecoder(*std::move(plan), convert));
  }
  [[nodiscard]] std::expected<scenegraph::AnyObject, scenegraph::DecodeError> decode(
      const MessageView& message) const override {
    Row row;
    if (const auto decoded = plan_.decode(message.data, &row); !decoded) {
      return std::unexpected(decoded.error());
    }
    return convert_(row, message);
  }

 private:
  RosDecoder(WirePlan plan, Convert convert) : plan_(std::move(plan)), convert_(convert) {}

  WirePlan plan_;
  Convert convert_;
};

}  // namespace stillframe::ingest
