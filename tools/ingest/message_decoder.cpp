#include "tools/ingest/message_decoder.h"

#include <algorithm>
#include <cstring>

#include "tools/ingest/converters/converter.h"
#include "tools/ingest/message_definition.h"
#include "tools/ingest/sentence.h"

namespace stillframe::ingest {

ChannelDecoder makeDecoder(const SchemaRecord* schema, std::string_view message_encoding) {
  if (schema == nullptr) {
    return {scenegraph::ObjectType::None, nullptr, "it has no schema"};
  }
  const std::string name = normalizedTypeName(schema->name);
  const auto converters = converterTypes();
  const auto converter = std::ranges::find(converters, std::string_view(name), &ConverterType::schema);
  if (converter == converters.end()) {
    return {scenegraph::ObjectType::None, nullptr, sentence("schema '", schema->name, "' is not drawable")};
  }
  auto decoder = converter->create(*schema, message_encoding);
  if (!decoder) {
    return {scenegraph::ObjectType::None, nullptr, std::move(decoder).error()};
  }
  return {converter->type, *std::move(decoder), ""};
}

scenegraph::Payload payloadOf(std::span<const std::byte> bytes, const MessageView& message) {
  constexpr std::size_t kMaxRatio = 8;
  if (bytes.size() >= message.anchored_bytes / kMaxRatio) {
    return {bytes, message.anchor};
  }
  auto copy = std::make_shared_for_overwrite<std::byte[]>(bytes.size());
  std::ranges::copy(bytes, copy.get());
  return {{copy.get(), bytes.size()}, copy};
}

}  // namespace stillframe::ingest
