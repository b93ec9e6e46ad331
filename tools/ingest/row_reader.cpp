#include "tools/ingest/row_reader.h"

#include <utility>

#include "tools/ingest/json_plan.h"
#include "tools/ingest/message_definition.h"
#include "tools/ingest/proto_plan.h"
#include "tools/ingest/sentence.h"
#include "tools/ingest/wire_plan.h"

namespace stillframe::ingest {

namespace {

using Made = std::expected<std::unique_ptr<RowReader>, std::string>;

/// Of a plan whose texts and bytes are views into the message itself.
template <typename Plan>
class ViewReader final : public RowReader {
 public:
  explicit ViewReader(Plan plan) : plan_(std::move(plan)) {}
  [[nodiscard]] std::expected<Read, scenegraph::DecodeError> read(const MessageView& message,
                                                                  void* row) const override {
    if (auto decoded = plan_.decode(message.data, row); !decoded) {
      return std::unexpected(std::move(decoded).error());
    }
    return Read{message, nullptr};
  }
  [[nodiscard]] bool readEarly(const MessageView& message, std::size_t there, void* row) const override {
    if constexpr (requires { plan_.decodeEarly(message.data, there, row); }) {
      return plan_.decodeEarly(message.data, there, row);
    }
    return false;
  }

 private:
  Plan plan_;
};

class JsonReader final : public RowReader {
 public:
  explicit JsonReader(JsonPlan plan) : plan_(std::move(plan)) {}
  [[nodiscard]] std::expected<Read, scenegraph::DecodeError> read(const MessageView& message,
                                                                  void* row) const override {
    auto kept = plan_.decode(message.data, row);
    if (!kept) {
      return std::unexpected(std::move(kept).error());
    }
    return Read{{message.data, kept->bytes, kept->byte_count, message.log_time}, kept->texts};
  }

 private:
  JsonPlan plan_;
};

Made makeRosReader(const SchemaRecord& schema, bool is_ros1, const Shape& shape) {
  const auto definitions =
      parseDefinitions(is_ros1 ? DefinitionLanguage::Ros1 : DefinitionLanguage::Ros2, schema.name, schema.data);
  if (!definitions) {
    return std::unexpected(sentence("definition cannot be parsed: ", definitions.error()));
  }
  auto plan = WirePlan::compile(*definitions, shape);
  if (!plan) {
    return std::unexpected(sentence("definition does not fit: ", plan.error()));
  }
  return std::make_unique<ViewReader<WirePlan>>(*std::move(plan));
}

}  // namespace

std::expected<std::unique_ptr<RowReader>, std::string> makeRowReader(const SchemaRecord& schema,
                                                                     std::string_view message_encoding,
                                                                     const Shape& shape) {
  const auto wrongSchema = [&] {
    return std::unexpected(
        sentence("schema encoding '", schema.encoding, "' is not supported with encoding '", message_encoding, "'"));
  };
  if (message_encoding == "cdr" || message_encoding == "ros1") {
    const bool is_ros1 = message_encoding == "ros1";
    return schema.encoding == (is_ros1 ? "ros1msg" : "ros2msg") ? makeRosReader(schema, is_ros1, shape) : wrongSchema();
  }
  if (message_encoding == "protobuf") {
    if (schema.encoding != "protobuf") {
      return wrongSchema();
    }
    auto plan = ProtoPlan::compile(schema.data, schema.name, shape);
    if (!plan) {
      return std::unexpected(sentence("definition does not fit: ", plan.error()));
    }
    return std::make_unique<ViewReader<ProtoPlan>>(*std::move(plan));
  }
  if (message_encoding == "json") {
    return schema.encoding == "jsonschema" || schema.encoding.empty()
               ? Made(std::make_unique<JsonReader>(JsonPlan::compile(shape)))
               : wrongSchema();
  }
  return std::unexpected(sentence("encoding '", message_encoding, "' is not supported"));
}

}  // namespace stillframe::ingest
