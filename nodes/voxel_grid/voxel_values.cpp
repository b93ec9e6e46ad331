#include "nodes/voxel_grid/voxel_values.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "nodes/points/read_value.h"

namespace stillframe::nodes {
namespace {

using scenegraph::FieldType;
using Kind = VoxelFormat::Kind;

constexpr std::uint32_t kSign = 0x80000000U;
/// Beyond this not every integer has its own float.
constexpr double kExactIntegers = 16'777'216.0;

bool isFloat(FieldType type) { return type == FieldType::Float32 || type == FieldType::Float64; }

/// Integers as they are, side by side; their limits while they are in the cache.
template <typename T>
ChannelValues copyIntegers(const PackedCells& cells, std::uint32_t offset, std::byte* out) {
  T low = std::numeric_limits<T>::max();
  T high = std::numeric_limits<T>::min();
  const std::byte* const data = cells.records.data.bytes.data() + offset;
  constexpr std::size_t kBlock = 16384;
  for (const PointRun& run : cells.all.runs) {
    for (std::size_t first = 0; first < run.count; first += kBlock) {
      const std::size_t count = std::min(kBlock, run.count - first);
      const std::byte* at = data + run.offset + first * cells.all.point_step;
      T* const values = reinterpret_cast<T*>(out);
      if (cells.all.point_step == sizeof(T)) {
        std::memcpy(values, at, count * sizeof(T));
      } else {
        for (std::size_t i = 0; i < count; ++i, at += cells.all.point_step) {
          values[i] = readValue<T, false>(at);
        }
      }
      for (std::size_t i = 0; i < count; ++i) {
        low = std::min(low, values[i]);
        high = std::max(high, values[i]);
      }
      out += count * sizeof(T);
    }
  }
  ChannelValues limits{
      .offset = 0.0, .low = static_cast<double>(low), .high = static_cast<double>(high), .finite = cells.all.points};
  if (std::max(std::abs(limits.low), std::abs(limits.high)) > kExactIntegers) {
    limits.offset = std::rint(limits.low / 2 + limits.high / 2);
  }
  return limits;
}

std::uint32_t floatKey(std::uint32_t bits) noexcept {
  bits = bits == kSign ? 0U : bits;  // -0 is 0
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

std::uint32_t keyOf(std::uint32_t raw, Kind kind) noexcept {
  return kind == Kind::Float ? floatKey(raw) : kind == Kind::Signed ? raw ^ kSign : raw;
}

/// Calls `function.template operator()<T>(const T* values)` with the type whose conversion to 32 bits is rawVoxel().
template <typename Function>
void withVoxels(std::span<const std::uint32_t> words, const VoxelFormat& format, const Function& function) {
  const auto* const bytes = reinterpret_cast<const std::byte*>(words.data());
  const bool is_signed = format.kind == Kind::Signed;
  if (format.shift == 2) {
    is_signed ? function(reinterpret_cast<const std::int8_t*>(bytes))
              : function(reinterpret_cast<const std::uint8_t*>(bytes));
  } else if (format.shift == 1) {
    is_signed ? function(reinterpret_cast<const std::int16_t*>(bytes))
              : function(reinterpret_cast<const std::uint16_t*>(bytes));
  } else {
    function(words.data());
  }
}

/// An interval of keys; None when it is empty.
VoxelTest keysTest(std::uint32_t first, std::uint32_t last) {
  return first <= last ? VoxelTest{.mode = VoxelTest::Mode::Keys, .first = first, .last = last}
                       : VoxelTest{.mode = VoxelTest::Mode::None};
}

/// Interval of integers, clamped to what the type holds.
VoxelTest integerTest(double first, double last, Kind kind) {
  const bool is_signed = kind == Kind::Signed;
  const double least = is_signed ? std::numeric_limits<std::int32_t>::min() : 0.0;
  const double most = is_signed ? std::numeric_limits<std::int32_t>::max() : std::numeric_limits<std::uint32_t>::max();
  if (!(first <= last) || last < least || first > most) {
    return {.mode = VoxelTest::Mode::None};
  }
  const auto key = [&](double value) {
    return keyOf(static_cast<std::uint32_t>(static_cast<std::int64_t>(std::clamp(value, least, most))), kind);
  };
  return keysTest(key(first), key(last));
}

}  // namespace

VoxelFormat voxelFormat(FieldType type) noexcept {
  switch (type) {
    case FieldType::Int8:
      return {Kind::Signed, 2};
    case FieldType::Uint8:
      return {Kind::Unsigned, 2};
    case FieldType::Int16:
      return {Kind::Signed, 1};
    case FieldType::Uint16:
      return {Kind::Unsigned, 1};
    case FieldType::Int32:
      return {Kind::Signed, 0};
    case FieldType::Uint32:
      return {Kind::Unsigned, 0};
    case FieldType::Float32:
    case FieldType::Float64:
    case FieldType::Unknown:
      break;
  }
  return {};
}

ChannelValues convertVoxels(const PackedCells& cells, const ChannelInfo& channel, std::span<std::uint32_t> words) {
  static_assert(std::endian::native == std::endian::little, "narrow values share words, the first in the low bits");
  if (isFloat(channel.type)) {
    return convertChannel(cells.records, cells.all, channel,
                          {reinterpret_cast<float*>(words.data()), cells.all.points});
  }
  ChannelValues limits;
  withFieldType(channel.type, false, [&]<typename T, bool kSwapped>() {
    if constexpr (std::is_integral_v<T>) {
      limits = copyIntegers<T>(cells, channel.offset, reinterpret_cast<std::byte*>(words.data()));
    }
  });
  return limits;
}

std::uint32_t rawVoxel(std::span<const std::uint32_t> words, const VoxelFormat& format, std::size_t i) noexcept {
  const std::uint32_t word = words[i >> format.shift];
  if (format.shift == 0) {
    return word;
  }
  const unsigned width = 32U >> format.shift;
  const auto at = static_cast<unsigned>(i & ((std::size_t{1} << format.shift) - 1)) * width;
  const std::uint32_t high = word << (32U - width - at);
  return format.kind == Kind::Signed ? static_cast<std::uint32_t>(static_cast<std::int32_t>(high) >> (32U - width))
                                     : high >> (32U - width);
}

double voxelValue(std::uint32_t raw, const VoxelFormat& format, const ChannelValues& limits) noexcept {
  if (format.kind == Kind::Float) {
    const auto value = std::bit_cast<float>(raw);
    return value <= kMissingValue ? std::numeric_limits<double>::quiet_NaN()
                                  : static_cast<double>(value) + limits.offset;
  }
  return format.kind == Kind::Signed ? static_cast<double>(static_cast<std::int32_t>(raw)) : static_cast<double>(raw);
}

VoxelTest makeVoxelTest(const VoxelRule& rule, FieldType type, const ChannelValues& limits) {
  using Mode = VoxelRule::Mode;
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  const Kind kind = voxelFormat(type).kind;
  if (rule.mode == Mode::All) {
    return {.mode = VoxelTest::Mode::All};
  }
  if (rule.mode == Mode::Bits) {
    return {.mode = VoxelTest::Mode::Bits, .bits = rule.bits};
  }
  if (kind != Kind::Float) {
    switch (rule.mode) {
      case Mode::Above:
        return integerTest(std::floor(rule.from) + 1.0, kEndless, kind);
      case Mode::Range:
        return integerTest(std::ceil(rule.from), std::floor(rule.to), kind);
      default:
        return integerTest(std::ceil(rule.from), std::floor(rule.from), kind);
    }
  }
  // A bound goes the way of the values: to float first where they are, then less the offset.
  const auto key = [&](double bound) {
    constexpr double kReach = kValueReach;
    const double as_stored = type == FieldType::Float32
                                 ? static_cast<double>(static_cast<float>(std::clamp(bound, -kReach, kReach)))
                                 : bound;
    const double relative = std::clamp(as_stored - limits.offset, -kReach, kReach);
    return floatKey(std::bit_cast<std::uint32_t>(static_cast<float>(relative)));
  };
  switch (rule.mode) {
    case Mode::Above:
      return keysTest(key(rule.from) + 1, floatKey(std::bit_cast<std::uint32_t>(std::numeric_limits<float>::max())));
    case Mode::Range:
      return rule.from <= rule.to ? keysTest(key(rule.from), key(rule.to)) : VoxelTest{.mode = VoxelTest::Mode::None};
    default:
      return keysTest(key(rule.from), key(rule.from));
  }
}

bool isDrawn(std::uint32_t raw, const VoxelFormat& format, const ChannelValues& limits,
             const VoxelTest& test) noexcept {
  switch (test.mode) {
    case VoxelTest::Mode::All:
      return true;
    case VoxelTest::Mode::None:
      return false;
    case VoxelTest::Mode::Keys:
      return keyOf(raw, format.kind) - test.first <= test.last - test.first;
    case VoxelTest::Mode::Bits:
      break;
  }
  if (format.kind != Kind::Float) {
    return (raw & test.bits) != 0;
  }
  // The number that the float stands for, where it fits.
  const float value = std::bit_cast<float>(raw);
  if (!(std::abs(value) < 2147483520.0F) || std::abs(limits.offset) >= 2147483648.0) {
    return false;
  }
  const auto whole = static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(value + 0.5F)));
  return ((whole + static_cast<std::uint32_t>(static_cast<std::int32_t>(limits.offset))) & test.bits) != 0;
}

std::size_t countDrawn(std::span<const std::uint32_t> words, const VoxelFormat& format, std::size_t voxels,
                       const ChannelValues& limits, const VoxelTest& test) {
  if (test.mode == VoxelTest::Mode::All || test.mode == VoxelTest::Mode::None) {
    return test.mode == VoxelTest::Mode::All ? voxels : 0;
  }
  std::size_t count = 0;
  withVoxels(words, format, [&]<typename T>(const T* values) {
    if (test.mode == VoxelTest::Mode::Keys) {
      for (std::size_t i = 0; i < voxels; ++i) {
        count += keyOf(static_cast<std::uint32_t>(values[i]), format.kind) - test.first <= test.last - test.first;
      }
      return;
    }
    for (std::size_t i = 0; i < voxels; ++i) {
      count += isDrawn(static_cast<std::uint32_t>(values[i]), format, limits, test) ? 1U : 0U;
    }
  });
  return count;
}

}  // namespace stillframe::nodes
