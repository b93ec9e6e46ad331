#include "nodes/points/codecs/cloudini_chunk.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "nodes/points/codecs/cloudini_reader.h"
#include "nodes/points/codecs/cloudini_section.h"

namespace stillframe::nodes::cloudini {
namespace {

bool isLossy(const Header& header, const Field& field, ValueType type) {
  return header.encoding == Encoding::Lossy && field.type == type && field.resolution.has_value();
}

bool isInSection(const Header& header, const Field& field) {
  return header.version >= 5 && header.encoding == Encoding::Lossy && byteSize(field.type) > 1 &&
         field.type != ValueType::Float32 && field.type != ValueType::Float64;
}

/// Fields at the front that a lossy encoder takes as one vector of integers of 32 bits: 3 or 4 floats, else none.
std::size_t leadingFloats(const Header& header) {
  const auto end = std::ranges::find_if_not(
      header.fields, [&](const Field& field) { return isLossy(header, field, ValueType::Float32); });
  const auto count = static_cast<std::size_t>(end - header.fields.begin());
  return count == 3 || count == 4 ? count : 0;
}

}  // namespace

ChunkDecoder::Column ChunkDecoder::makeColumn(const Header& header, const Field& field, bool is_leading) {
  Column column;
  column.size = byteSize(field.type);
  column.offset = field.offset;
  column.is_stored = field.isInPoint(header.point_step);
  if (header.encoding == Encoding::None) {
    return column;
  }
  if (field.type == ValueType::Float32) {
    if (isLossy(header, field, ValueType::Float32)) {
      column.kind = is_leading ? Kind::LossyVector : Kind::LossyFloat;
      // The encoder multiplies by the reciprocal rounded to float: that, taken back in double, is the quantum in use.
      column.quantum = 1.0 / static_cast<double>(1.0F / *field.resolution);
    } else if (header.encoding == Encoding::Lossless) {
      column.kind = Kind::XorFloat;
    }
  } else if (field.type == ValueType::Float64) {
    if (isLossy(header, field, ValueType::Float64)) {
      column.kind = Kind::LossyDouble;
      column.quantum = static_cast<double>(*field.resolution);
    } else {
      column.kind = header.version >= 4 && !field.resolution ? Kind::Gorilla : Kind::XorDouble;
    }
  } else if (column.size > 1) {
    column.kind = Kind::Integer;
  }
  return column;
}

ChunkDecoder::ChunkDecoder(const Header& header) : point_step_(header.point_step) {
  const std::size_t leading = leadingFloats(header);
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    const Column column = makeColumn(header, header.fields[i], i < leading);
    if (isInSection(header, header.fields[i])) {
      sections_.push_back(column);
      continue;
    }
    columns_.push_back(column);
    const bool has_fixed_size =
        column.kind == Kind::Copy || column.kind == Kind::XorFloat || column.kind == Kind::XorDouble;
    // A changed double of the Gorilla kind takes 1 + 1 + 5 + 6 + 64 bits at worst, an unchanged one a bit.
    min_point_bytes_ += has_fixed_size ? column.size : 1;
    max_point_bytes_ += has_fixed_size ? column.size : static_cast<std::uint32_t>(kMaxVarintBytes);
  }
}

std::uint64_t ChunkDecoder::minBytes(std::uint64_t points) const noexcept {
  return points * min_point_bytes_ + (points > 0 ? sections_.size() * 4 : 0);
}

std::uint64_t ChunkDecoder::maxBytes(std::uint64_t points) const noexcept {
  // A section is longest as a run for each value: 8 bytes or a varint, then a length, behind a mode and a count.
  return points * (max_point_bytes_ + sections_.size() * 2 * kMaxVarintBytes) + sections_.size() * 8;
}

template <typename Reader>
void ChunkDecoder::decodeGorilla(Column& column, Reader& reader) {
  constexpr unsigned kBits = 64;
  BitReader<Reader> bits(reader);
  if (column.is_first) {
    column.is_first = false;
    column.previous = bits.bits(kBits);
    return;
  }
  if (bits.bits(1) == 0) {
    return;
  }
  if (bits.bits(1) != 0) {
    column.leading = static_cast<unsigned>(bits.bits(5));
    column.window = static_cast<unsigned>(bits.bits(6)) + 1;
  }
  if (column.window == 0 || column.leading + column.window > kBits) {
    reader.fail();
    return;
  }
  column.previous ^= bits.bits(column.window) << (kBits - column.leading - column.window);
}

/// The bits of the next value.
template <typename Reader>
std::uint64_t ChunkDecoder::decodeValue(Column& column, Reader& reader) {
  switch (column.kind) {
    case Kind::Copy:
      return reader.raw(column.size);
    case Kind::Integer:
      column.previous += reader.difference().value;
      return column.previous;
    case Kind::LossyVector:
    case Kind::LossyFloat:
    case Kind::LossyDouble: {
      const auto difference = reader.difference();
      double value = std::numeric_limits<double>::quiet_NaN();
      if (difference.is_nan) {
        column.previous = 0;
      } else {
        column.previous += difference.value;
        // As part of a vector the encoder counts in 32 bits, which wrap.
        value = static_cast<double>(column.kind == Kind::LossyVector
                                        ? static_cast<std::int64_t>(static_cast<std::int32_t>(column.previous))
                                        : static_cast<std::int64_t>(column.previous)) *
                column.quantum;
      }
      return column.kind == Kind::LossyDouble ? std::bit_cast<std::uint64_t>(value)
                                              : std::bit_cast<std::uint32_t>(static_cast<float>(value));
    }
    case Kind::XorFloat:
    case Kind::XorDouble:
      column.previous ^= reader.raw(column.size);
      return column.previous;
    case Kind::Gorilla:
      decodeGorilla(column, reader);
      return column.previous;
  }
  return 0;
}

template <typename Reader>
void ChunkDecoder::decodePoint(std::vector<Column>& columns, Reader& reader, std::byte* point) {
  for (Column& column : columns) {
    const std::uint64_t value = decodeValue(column, reader);
    if (column.is_stored) {
      std::memcpy(point + column.offset, &value, column.size);
    }
  }
}

bool ChunkDecoder::decode(std::span<const std::byte> chunk, std::byte* output, std::size_t points) {
  for (Column& column : columns_) {
    column.previous = 0;
    column.window = 0;
    column.is_first = true;
  }
  const std::byte* const end = chunk.data() + chunk.size();
  std::byte* point = output;
  std::size_t done = 0;
  // As long as the longest point would fit, nobody needs to look for the end.
  FastReader fast(chunk.data(), end);
  while (done < points && fast.left() >= max_point_bytes_ && !fast.hasFailed()) {
    decodePoint(columns_, fast, point);
    point += point_step_;
    ++done;
  }
  if (fast.hasFailed()) {
    return false;
  }
  Reader reader(fast.at(), end);
  while (done < points && !reader.hasFailed()) {
    decodePoint(columns_, reader, point);
    point += point_step_;
    ++done;
  }
  for (const Column& section : sections_) {
    readSection(reader, {.first = section.is_stored ? output + section.offset : nullptr,
                         .step = point_step_,
                         .points = points,
                         .value_bytes = section.size});
  }
  return !reader.hasFailed() && reader.left() == 0;
}

}  // namespace stillframe::nodes::cloudini
