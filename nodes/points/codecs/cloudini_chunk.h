#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nodes/points/codecs/cloudini_header.h"

namespace stillframe::nodes::cloudini {

/// Points of a chunk; only the last has fewer.
constexpr std::size_t kPointsPerChunk = 32768;

/// The first stage of one kind of cloud: turns the bytes of a chunk into points.
///
/// Values of one point lie side by side; from version 5 on, the integers of a lossy cloud follow behind all points, a
/// section each. Every chunk begins anew, so chunks are independent. One thread at a time.
class ChunkDecoder {
 public:
  explicit ChunkDecoder(const Header& header);

  /// Fewest and most bytes that a chunk of so many points can have before its second stage.
  [[nodiscard]] std::uint64_t minBytes(std::uint64_t points) const noexcept;
  [[nodiscard]] std::uint64_t maxBytes(std::uint64_t points) const noexcept;

  /// Writes the fields of `points` points from `output` on; other bytes of the points are left as they are. Returns
  /// whether `chunk` holds exactly these points.
  [[nodiscard]] bool decode(std::span<const std::byte> chunk, std::byte* output, std::size_t points);

 private:
  enum class Kind : std::uint8_t { Copy, Integer, LossyVector, LossyFloat, LossyDouble, XorFloat, XorDouble, Gorilla };

  /// A field in the stream of points, with what it remembers of the point before.
  struct Column {
    Kind kind = Kind::Copy;
    std::uint32_t size = 0;  // bytes of a value
    std::uint32_t offset = 0;
    bool is_stored = true;
    double quantum = 0.0;
    std::uint64_t previous = 0;
    unsigned leading = 0;  // Gorilla: the window of the value before
    unsigned window = 0;   // bits of it; 0: none yet
    bool is_first = true;
  };

  template <typename Reader>
  static void decodePoint(std::vector<Column>& columns, Reader& reader, std::byte* point);
  template <typename Reader>
  static std::uint64_t decodeValue(Column& column, Reader& reader);
  template <typename Reader>
  static void decodeGorilla(Column& column, Reader& reader);
  [[nodiscard]] static Column makeColumn(const Header& header, const Field& field, bool is_leading);

  std::vector<Column> columns_;
  std::vector<Column> sections_;
  std::uint32_t point_step_ = 0;
  std::uint32_t min_point_bytes_ = 0;
  std::uint32_t max_point_bytes_ = 0;
};

}  // namespace stillframe::nodes::cloudini
