#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "nodes/points/codecs/codec_error.h"

namespace stillframe::nodes::cloudini {

/// First stage: how values become bytes. The numbers are the binary header's.
enum class Encoding : std::uint8_t { None = 0, Lossy = 1, Lossless = 2 };
/// Second stage, over a whole chunk.
enum class Compression : std::uint8_t { None = 0, Lz4 = 1, Zstd = 2 };
/// 1 to 8 are those of sensor_msgs/PointField.
enum class ValueType : std::uint8_t {
  Int8 = 1,
  Uint8 = 2,
  Int16 = 3,
  Uint16 = 4,
  Int32 = 5,
  Uint32 = 6,
  Float32 = 7,
  Float64 = 8,
  Int64 = 9,
  Uint64 = 10,
};
[[nodiscard]] std::uint32_t byteSize(ValueType type) noexcept;

struct Field {
  /// This offset in a header: the field is in the stream, but not in the point.
  static constexpr std::uint32_t kNotStored = 0xffffffff;

  std::string name;
  std::uint32_t offset = 0;
  ValueType type = ValueType::Float32;
  std::optional<float> resolution;  ///< quantum of a lossy field; the error is at most half of it

  [[nodiscard]] bool isInPoint(std::uint32_t point_step) const noexcept {
    return std::uint64_t{offset} + byteSize(type) <= point_step;
  }
};

struct Header {
  unsigned version = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 1;
  std::uint32_t point_step = 0;  ///< bytes
  Encoding encoding = Encoding::Lossy;
  Compression compression = Compression::Zstd;
  std::vector<Field> fields;
  std::size_t size = 0;  ///< bytes of the header itself: the first chunk begins here

  [[nodiscard]] std::uint64_t points() const noexcept { return std::uint64_t{width} * height; }
};

/// The header at the front of a blob: the magic "CLOUDINI_V" with two digits, then binary or YAML text up to a NUL.
///
/// Nothing is checked against the bytes behind it. At most 1024 fields.
[[nodiscard]] std::expected<Header, CodecError> readHeader(std::span<const std::byte> blob);

}  // namespace stillframe::nodes::cloudini
