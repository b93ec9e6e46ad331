// Decodes a JSON message: a byte for the schema, then the message.
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
  const ingest::SchemaRecord schema{1, std::string(converters[data[0] % converters.size()].schema), "jsonschema", ""};
  const auto decoder = ingest::makeDecoder(&schema, "json", "/robot_description");
  if (decoder.decoder != nullptr) {
    const auto message = std::as_bytes(std::span(data + 1, size - 1));
    static_cast<void>(decoder.decoder->decode({message, nullptr, message.size(), {0}}));
  }
  return 0;
}
