// Decodes a protobuf message by descriptors, both of the input: a byte for the schema, the size of the descriptors in
// two bytes (little-endian), the descriptors, the message.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "tools/ingest/converters/converter.h"
#include "tools/ingest/message_decoder.h"

using namespace stillframe;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 3) {
    return 0;
  }
  const auto converters = ingest::converterTypes();
  const std::size_t descriptor_bytes = std::min<std::size_t>(data[1] + 256u * data[2], size - 3);
  ingest::SchemaRecord schema{1, std::string(converters[data[0] % converters.size()].schema), "protobuf", ""};
  schema.data.assign(data + 3, data + 3 + descriptor_bytes);
  const auto decoder = ingest::makeDecoder(&schema, "protobuf", "/robot_description");
  if (decoder.decoder != nullptr) {
    const auto message = std::as_bytes(std::span(data + 3 + descriptor_bytes, size - 3 - descriptor_bytes));
    static_cast<void>(decoder.decoder->decode({message, nullptr, message.size(), {0}}));
  }
  return 0;
}
