#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <string>
#include <string_view>
#include <vector>

namespace stillframe::ingest {

/// What one element of a field is on the wire.
enum class WireType : std::uint8_t {
  Bool,
  Int8,
  Uint8,  ///< also ROS 1 `char`, and `byte`
  Int16,
  Uint16,
  Int32,
  Uint32,
  Int64,
  Uint64,
  Float32,
  Float64,
  String,
  WString,
  Time,      ///< ROS 1: two uint32; written out in ROS 2
  Duration,  ///< ROS 1: two int32
  Message,
};

/// One field of a message.
struct FieldDefinition {
  enum class Array : std::uint8_t {
    None,
    Fixed,     ///< `T[5]`: exactly `length` elements
    Sequence,  ///< `T[]` and `T[<=5]`: a count, then the elements (a bound is not checked)
  };
  std::string name;
  WireType type = WireType::Bool;
  Array array = Array::None;
  std::uint32_t length = 0;
  std::size_t message = 0;  ///< index into MessageDefinitions::messages when type is Message
};

struct MessageDefinition {
  std::string name;  ///< "pkg/Type"
  std::vector<FieldDefinition> fields;
};

/// Which language a definition is written in: the wire follows from it.
enum class DefinitionLanguage : std::uint8_t { Ros1, Ros2 };

/// A message and every message it holds, as written in the schema of a recording.
///
/// The root is messages[0]. No message holds itself, they nest at most kMaxDepth deep, and every Message field names an
/// existing one.
struct MessageDefinitions {
  static constexpr std::size_t kMaxDepth = 64;
  DefinitionLanguage language = DefinitionLanguage::Ros2;
  std::vector<MessageDefinition> messages;
};

/// `pkg/msg/Type` and `pkg/Type` as "pkg/Type".
[[nodiscard]] std::string normalizedTypeName(std::string_view name);

/// Parses the text of a "ros1msg" or "ros2msg" schema: the fields of `name`, then sections that each begin with a line
/// of `=` and `MSG: pkg/Type`. The error is one sentence with the line or type that is wrong.
[[nodiscard]] std::expected<MessageDefinitions, std::string> parseDefinitions(DefinitionLanguage language,
                                                                              std::string_view name,
                                                                              std::string_view text);

}  // namespace stillframe::ingest
