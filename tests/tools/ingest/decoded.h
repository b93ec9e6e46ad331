#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <span>
#include <string_view>

#include "tools/ingest/message_decoder.h"

namespace stillframe::ingest::test {

/// The object that a message of that schema becomes; none, and a failure, when it becomes none.
inline scenegraph::AnyObject decoded(const SchemaRecord& schema, std::string_view encoding,
                                     std::span<const std::byte> bytes) {
  const auto decoder = makeDecoder(&schema, encoding, "/topic");
  EXPECT_EQ(decoder.unsupported_reason, "");
  if (decoder.decoder == nullptr) {
    return {};
  }
  auto object = decoder.decoder->decode({bytes, nullptr, 1, {0}});  // a block of one byte: views always
  EXPECT_TRUE(object) << object.error().message;
  return object ? *object : scenegraph::AnyObject{};
}

}  // namespace stillframe::ingest::test
