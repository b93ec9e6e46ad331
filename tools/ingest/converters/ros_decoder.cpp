#include "tools/ingest/converters/ros_decoder.h"

#include "tools/ingest/message_definition.h"
#include "tools/ingest/sentence.h"

namespace stillframe::ingest {

std::expected<WirePlan, std::string> compileRosPlan(const SchemaRecord& schema, std::string_view message_encoding,
                                                    const Shape& shape) {
  if (message_encoding != "cdr" && message_encoding != "ros1") {
    return std::unexpected(sentence("encoding '", message_encoding, "' is not supported"));
  }
  const bool is_ros1 = message_encoding == "ros1";
  if (schema.encoding != (is_ros1 ? "ros1msg" : "ros2msg")) {
    return std::unexpected(
        sentence("schema encoding '", schema.encoding, "' is not supported with encoding '", message_encoding, "'"));
  }
  const auto definitions =
      parseDefinitions(is_ros1 ? DefinitionLanguage::Ros1 : DefinitionLanguage::Ros2, schema.name, schema.data);
  if (!definitions) {
    return std::unexpected(sentence("definition cannot be parsed: ", definitions.error()));
  }
  auto plan = WirePlan::compile(*definitions, shape);
  if (!plan) {
    return std::unexpected(sentence("definition does not fit: ", plan.error()));
  }
  return plan;
}

}  // namespace stillframe::ingest
