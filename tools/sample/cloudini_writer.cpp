#include "tools/sample/cloudini_writer.h"

#include <lz4.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace stillframe::sample {
namespace {

using namespace nodes::cloudini;

using Bytes = std::vector<std::byte>;
constexpr std::size_t kChunk = 32768;

template <typename T>
void put(Bytes& out, const T& value, std::size_t size = sizeof(T)) {
  const auto* const bytes = reinterpret_cast<const std::byte*>(&value);
  out.insert(out.end(), bytes, bytes + size);
}
void putText(Bytes& out, const std::string& text) {
  const auto* const bytes = reinterpret_cast<const std::byte*>(text.data());
  out.insert(out.end(), bytes, bytes + text.size());
}
void putVarint(Bytes& out, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) {
    put(out, static_cast<std::uint8_t>(value | 0x80));
  }
  put(out, static_cast<std::uint8_t>(value));
}
void putDifference(Bytes& out, std::int64_t difference) {
  putVarint(out, ((static_cast<std::uint64_t>(difference) << 1) ^ static_cast<std::uint64_t>(difference >> 63)) + 1);
}

/// Bits, low ones first, filled up to a byte when done.
class BitWriter {
 public:
  explicit BitWriter(Bytes& out) : out_(out) {}
  ~BitWriter() {
    if (held_ > 0) {
      put(out_, static_cast<std::uint8_t>(byte_));
    }
  }
  void bits(std::uint64_t value, unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
      byte_ |= static_cast<unsigned>((value >> i) & 1U) << held_;
      if (++held_ == 8) {
        put(out_, static_cast<std::uint8_t>(byte_));
        byte_ = held_ = 0;
      }
    }
  }

 private:
  Bytes& out_;
  unsigned byte_ = 0;
  unsigned held_ = 0;
};

std::uint64_t bitsAt(const std::byte* at, ValueType type) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, at, byteSize(type));
  return bits;
}
std::int64_t integerAt(const std::byte* at, ValueType type) {
  const std::uint64_t bits = bitsAt(at, type);
  switch (type) {
    case ValueType::Int16:
      return static_cast<std::int16_t>(bits);
    case ValueType::Int32:
      return static_cast<std::int32_t>(bits);
    default:
      return static_cast<std::int64_t>(bits);
  }
}
double realAt(const std::byte* at, ValueType type) {
  const std::uint64_t bits = bitsAt(at, type);
  return type == ValueType::Float32 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
                                    : std::bit_cast<double>(bits);
}

struct State {
  std::int64_t integer = 0;
  std::uint64_t bits = 0;
  unsigned leading = 0;
  unsigned trailing = 0;
  bool is_first = true;
  bool has_window = false;
};

void putGorilla(Bytes& out, State& state, std::uint64_t value) {
  BitWriter bits(out);
  const std::uint64_t changed = value ^ state.bits;
  state.bits = value;
  if (state.is_first) {
    state.is_first = false;
    bits.bits(value, 64);
    return;
  }
  bits.bits(changed != 0 ? 1 : 0, 1);
  if (changed == 0) {
    return;
  }
  const auto leading = static_cast<unsigned>(std::countl_zero(changed));
  const auto trailing = static_cast<unsigned>(std::countr_zero(changed));
  const bool fits = state.has_window && leading >= state.leading && trailing >= state.trailing;
  bits.bits(fits ? 0 : 1, 1);
  if (!fits) {
    state.leading = std::min(leading, 31U);
    state.trailing = trailing;
    state.has_window = true;
    bits.bits(state.leading, 5);
    bits.bits(64 - state.leading - trailing - 1, 6);
  }
  bits.bits(changed >> state.trailing, 64 - state.leading - state.trailing);
}

void putValue(Bytes& out, const Header& header, const Field& field, State& state, const std::byte* point) {
  const std::byte* const at = point + field.offset;
  const bool is_real = field.type == ValueType::Float32 || field.type == ValueType::Float64;
  const bool is_copied = header.encoding == Encoding::None || byteSize(field.type) == 1 ||
                         (header.encoding == Encoding::Lossy && field.type == ValueType::Float32 && !field.resolution);
  if (is_copied) {
    put(out, bitsAt(at, field.type), byteSize(field.type));
  } else if (!is_real) {
    const std::int64_t value = integerAt(at, field.type);
    putDifference(
        out, static_cast<std::int64_t>(static_cast<std::uint64_t>(value) - static_cast<std::uint64_t>(state.integer)));
    state.integer = value;
  } else if (header.encoding == Encoding::Lossy && field.resolution) {
    const double value = realAt(at, field.type);
    if (std::isnan(value)) {
      put(out, std::uint8_t{0});
      state.integer = 0;
      return;
    }
    const std::int64_t integer = field.type == ValueType::Float32
                                     ? std::llround(static_cast<float>(value) * (1.0F / *field.resolution))
                                     : std::llround(value * (1.0 / static_cast<double>(*field.resolution)));
    putDifference(out, integer - state.integer);
    state.integer = integer;
  } else if (field.type == ValueType::Float64 && header.version >= 4 && !field.resolution) {
    putGorilla(out, state, bitsAt(at, field.type));
  } else {
    const std::uint64_t value = bitsAt(at, field.type);
    put(out, value ^ state.bits, byteSize(field.type));
    state.bits = value;
  }
}

void putPalette(Bytes& out, const std::vector<std::int64_t>& values, std::size_t size) {
  std::vector<std::int64_t> palette(values);
  std::ranges::sort(palette);
  palette.erase(std::ranges::unique(palette).begin(), palette.end());
  put(out, static_cast<std::uint16_t>(palette.size()));
  for (const std::int64_t value : palette) {
    put(out, value, size);
  }
  BitWriter bits(out);
  for (const std::int64_t value : values) {
    bits.bits(static_cast<std::uint64_t>(std::ranges::lower_bound(palette, value) - palette.begin()),
              static_cast<unsigned>(std::bit_width(palette.size() - 1)));
  }
}

void putSection(Bytes& out, SectionMode mode, const std::vector<std::int64_t>& values, std::size_t size) {
  put(out, mode);
  if (mode == SectionMode::Palette) {
    return putPalette(out, values, size);
  }
  std::vector<std::int64_t> written(values);
  if (mode != SectionMode::Runs) {
    for (std::size_t i = written.size() - 1; i > 0; --i) {
      written[i] = static_cast<std::int64_t>(static_cast<std::uint64_t>(written[i]) -
                                             static_cast<std::uint64_t>(written[i - 1]));
    }
  }
  if (mode == SectionMode::Differences) {
    std::ranges::for_each(written, [&](std::int64_t value) { putDifference(out, value); });
    return;
  }
  const std::size_t count_at = out.size();
  std::uint32_t runs = 0;
  put(out, runs);
  for (std::size_t i = 0; i < written.size(); ++runs) {
    std::size_t end = i;
    while (end < written.size() && written[end] == written[i]) {
      ++end;
    }
    if (mode == SectionMode::Runs) {
      put(out, written[i], size);
    } else {
      putDifference(out, written[i]);
    }
    putVarint(out, end - i);
    i = end;
  }
  std::memcpy(out.data() + count_at, &runs, sizeof(runs));
}

Bytes writeChunk(const Header& header, std::span<const std::byte> points, SectionMode mode) {
  Bytes out;
  const auto has_section = [&](const Field& field) {
    return header.version >= 5 && header.encoding == Encoding::Lossy && byteSize(field.type) > 1 &&
           field.type != ValueType::Float32 && field.type != ValueType::Float64;
  };
  std::vector<State> states(header.fields.size());
  for (std::size_t at = 0; at < points.size(); at += header.point_step) {
    for (std::size_t i = 0; i < header.fields.size(); ++i) {
      if (!has_section(header.fields[i])) {
        putValue(out, header, header.fields[i], states[i], points.data() + at);
      }
    }
  }
  for (const Field& field : header.fields) {
    if (has_section(field)) {
      std::vector<std::int64_t> values;
      for (std::size_t at = 0; at < points.size(); at += header.point_step) {
        values.push_back(integerAt(points.data() + at + field.offset, field.type));
      }
      putSection(out, mode, values, byteSize(field.type));
    }
  }
  return out;
}

Bytes pack(Compression compression, const Bytes& chunk) {
  if (compression == Compression::None) {
    return chunk;
  }
  const bool is_lz4 = compression == Compression::Lz4;
  Bytes packed(is_lz4 ? static_cast<std::size_t>(LZ4_compressBound(static_cast<int>(chunk.size())))
                      : ZSTD_compressBound(chunk.size()));
  packed.resize(is_lz4 ? static_cast<std::size_t>(LZ4_compress_default(
                             reinterpret_cast<const char*>(chunk.data()), reinterpret_cast<char*>(packed.data()),
                             static_cast<int>(chunk.size()), static_cast<int>(packed.size())))
                       : ZSTD_compress(packed.data(), packed.size(), chunk.data(), chunk.size(), 1));
  return packed;
}

}  // namespace

Bytes writeCloudiniHeader(const Header& header, bool is_binary) {
  Bytes out;
  putText(out, "CLOUDINI_V0" + std::to_string(header.version));
  if (is_binary) {
    put(out, header.width);
    put(out, header.height);
    put(out, header.point_step);
    put(out, header.encoding);
    put(out, header.compression);
    put(out, static_cast<std::uint16_t>(header.fields.size()));
    for (const Field& field : header.fields) {
      put(out, static_cast<std::uint16_t>(field.name.size()));
      putText(out, field.name);
      put(out, field.offset);
      put(out, field.type);
      put(out, field.resolution.value_or(-1.0F));
    }
    return out;
  }
  static constexpr std::array kTypes = {"UNKNOWN", "INT8",    "UINT8",   "INT16", "UINT16", "INT32",
                                        "UINT32",  "FLOAT32", "FLOAT64", "INT64", "UINT64"};
  static constexpr std::array kEncodings = {"NONE", "LOSSY", "LOSSLESS"};
  static constexpr std::array kCompressions = {"NONE", "LZ4", "ZSTD"};
  std::string text =
      "\nversion: " + std::to_string(header.version) + "\nwidth: " + std::to_string(header.width) +
      "\nheight: " + std::to_string(header.height) + "\npoint_step: " + std::to_string(header.point_step) +
      "\nencoding_opt: " + kEncodings.at(static_cast<std::size_t>(header.encoding)) +
      "\ncompression_opt: " + kCompressions.at(static_cast<std::size_t>(header.compression)) + "\nfields:\n";
  for (const Field& field : header.fields) {
    text += "  - name: " + field.name + "\n    offset: " + std::to_string(field.offset) +
            "\n    type: " + kTypes.at(static_cast<std::size_t>(field.type)) +
            "\n    resolution: " + (field.resolution ? std::to_string(*field.resolution) : "null") + "\n";
  }
  putText(out, text);
  put(out, '\0');
  return out;
}

Bytes writeCloudini(const Header& header, std::span<const std::byte> points, CloudiniOptions options) {
  Bytes out = writeCloudiniHeader(header, options.has_binary_header);
  while (!points.empty()) {
    const std::size_t size = std::min(points.size(), kChunk * header.point_step);
    const Bytes packed = pack(header.compression, writeChunk(header, points.first(size), options.section_mode));
    put(out, static_cast<std::uint32_t>(packed.size()));
    out.insert(out.end(), packed.begin(), packed.end());
    points = points.subspan(size);
  }
  return out;
}

scenegraph::Payload toPayload(Bytes bytes) {
  const auto anchor = std::make_shared<const Bytes>(std::move(bytes));
  return {*anchor, anchor};
}

}  // namespace stillframe::sample
