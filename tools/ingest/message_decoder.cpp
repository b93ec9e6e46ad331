#include "tools/ingest/message_decoder.h"

#include <algorithm>
#include <cstring>

#include "tools/ingest/converters/converter.h"
#include "tools/ingest/message_definition.h"
#include "tools/ingest/sentence.h"

namespace stillframe::ingest {

namespace {

/// nullptr for a schema that nothing is drawn from.
const ConverterType* findConverter(const SchemaRecord& schema) {
  const std::string name = normalizedTypeName(schema.name);
  const auto converters = converterTypes();
  const auto found = std::ranges::find(converters, std::string_view(name), &ConverterType::schema);
  return found == converters.end() ? nullptr : &*found;
}

}  // namespace

bool dependsOnTopic(const SchemaRecord& schema) {
  const ConverterType* converter = findConverter(schema);
  return converter != nullptr && !converter->topic_segment.empty();
}

ChannelDecoder makeDecoder(const SchemaRecord* schema, std::string_view message_encoding, std::string_view topic) {
  if (schema == nullptr) {
    return {scenegraph::ObjectType::None, nullptr, "it has no schema"};
  }
  const ConverterType* converter = findConverter(*schema);
  if (converter == nullptr) {
    return {scenegraph::ObjectType::None, nullptr, sentence("schema '", schema->name, "' is not drawable")};
  }
  const std::string_view segment = topic.substr(topic.rfind('/') + 1);  // npos + 1 is 0
  if (!converter->topic_segment.empty() && segment != converter->topic_segment) {
    return {scenegraph::ObjectType::None, nullptr,
            sentence("schema '", schema->name, "' is drawable only on topics named ", converter->topic_segment)};
  }
  auto decoder = converter->create(*schema, message_encoding);
  if (!decoder) {
    return {scenegraph::ObjectType::None, nullptr, std::move(decoder).error()};
  }
  return {converter->type, *std::move(decoder), ""};
}

scenegraph::Payload payloadOf(std::span<const std::byte> bytes, const MessageView& message) {
  constexpr std::size_t kMaxRatio = 8;
  if (message.arrival != nullptr) {
    return {bytes, message.anchor, message.arrival,
            message.place + static_cast<std::size_t>(bytes.data() - message.data.data())};
  }
  if (bytes.size() >= message.anchored_bytes / kMaxRatio) {
    return {bytes, message.anchor};
  }
  auto copy = std::make_shared_for_overwrite<std::byte[]>(bytes.size());
  std::ranges::copy(bytes, copy.get());
  return {{copy.get(), bytes.size()}, copy};
}

}  // namespace stillframe::ingest
