// Decodes a message by a definition, both of the input: a byte for the schema, the definition up to a NUL, the message.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "tools/ingest/converters/converter.h"
#include "tools/ingest/message_decoder.h"

using namespace stillframe;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  const auto converters = ingest::converterTypes();
  const bool is_ros1 = (data[0] & 0x80u) != 0;
  const std::span<const std::uint8_t> rest(data + 1, size - 1);
  const auto end = std::ranges::find(rest, std::uint8_t{0});
  ingest::SchemaRecord schema;
  schema.id = 1;
  schema.name = converters[(data[0] & 0x7Fu) % converters.size()].schema;
  schema.encoding = is_ros1 ? "ros1msg" : "ros2msg";
  schema.data.assign(rest.begin(), end);
  const auto decoder = ingest::makeDecoder(&schema, is_ros1 ? "ros1" : "cdr", "/robot_description");
  if (decoder.decoder != nullptr && end != rest.end()) {
    const auto message = std::as_bytes(std::span(end + 1, rest.end()));
    static_cast<void>(decoder.decoder->decode({message, nullptr, message.size(), {0}}));
  }
  return 0;
}
