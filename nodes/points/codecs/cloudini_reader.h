#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace stillframe::nodes::cloudini {

static_assert(std::endian::native == std::endian::little, "the stream is little-endian and is copied as it is");

/// Longest varint: nine groups of seven bits and one bit more.
constexpr std::size_t kMaxVarintBytes = 10;

/// Reads the bytes of a chunk. The first read that is not possible fails it; what it gives from then on means nothing.
///
/// Without `kIsChecked` the caller has seen to it that the bytes of a whole point are there, the longest possible.
template <bool kIsChecked>
class BasicReader {
 public:
  BasicReader(const std::byte* begin, const std::byte* end) : at_(begin), end_(end) {}

  [[nodiscard]] bool hasFailed() const noexcept { return has_failed_; }
  [[nodiscard]] std::size_t left() const noexcept { return static_cast<std::size_t>(end_ - at_); }
  [[nodiscard]] const std::byte* at() const noexcept { return at_; }
  void fail() noexcept {
    has_failed_ = true;
    if (kIsChecked) {  // else the rest of the point is still to be read, and is there
      at_ = end_;
    }
  }

  /// The next `size` bytes, at most 8, as an unsigned number.
  [[nodiscard]] std::uint64_t raw(std::size_t size) noexcept {
    if (kIsChecked && left() < size) {
      fail();
      return 0;
    }
    std::uint64_t value = 0;
    std::memcpy(&value, at_, size);
    at_ += size;
    return value;
  }

  /// Seven bits a byte, low ones first; the top bit says that more follow.
  [[nodiscard]] std::uint64_t varint() noexcept {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      if (kIsChecked && at_ == end_) {
        break;
      }
      const auto group = static_cast<std::uint64_t>(*at_++);
      value |= (group & 0x7f) << shift;
      if (group < 0x80) {
        if (shift == 63 && group > 1) {
          break;
        }
        return value;
      }
    }
    fail();
    return 0;
  }

  /// A varint of one more than the zigzag of a signed difference. 0 stands for NaN among floats; among integers it is
  /// what the difference -2^63 comes to, since the one more wraps.
  struct Difference {
    bool is_nan = false;
    std::uint64_t value = 0;  ///< modulo 2^64
  };
  [[nodiscard]] Difference difference() noexcept {
    const std::uint64_t coded = varint();
    const std::uint64_t zigzag = coded - 1;
    return {.is_nan = coded == 0, .value = (zigzag >> 1) ^ (~(zigzag & 1) + 1)};
  }

 private:
  const std::byte* at_;
  const std::byte* end_;
  bool has_failed_ = false;
};

using Reader = BasicReader<true>;
using FastReader = BasicReader<false>;

/// Bits, low ones of a byte first, out of a reader; what is left of the last byte is skipped when it is destroyed.
template <typename ByteReader>
class BitReader {
 public:
  explicit BitReader(ByteReader& reader) : reader_(reader) {}
  /// At most 64.
  [[nodiscard]] std::uint64_t bits(unsigned count) noexcept {
    std::uint64_t value = 0;
    unsigned got = 0;
    while (got < count) {
      if (held_ == 0) {
        byte_ = static_cast<unsigned>(reader_.raw(1));
        held_ = 8;
      }
      const unsigned take = count - got < held_ ? count - got : held_;
      value |= static_cast<std::uint64_t>(byte_ & ((1U << take) - 1U)) << got;
      byte_ >>= take;
      held_ -= take;
      got += take;
    }
    return value;
  }

 private:
  ByteReader& reader_;
  unsigned byte_ = 0;
  unsigned held_ = 0;
};

}  // namespace stillframe::nodes::cloudini
