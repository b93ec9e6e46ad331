#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace stillframe::ingest {

/// ROS 2 in this machine's byte order: fields aligned to their size.
struct CdrLittle {
  static constexpr bool kIsSwapped = false;
  static constexpr bool kIsAligned = true;
  static constexpr bool kHasTerminator = true;
};
/// ROS 2 written on a big-endian machine.
struct CdrBig {
  static constexpr bool kIsSwapped = true;
  static constexpr bool kIsAligned = true;
  static constexpr bool kHasTerminator = true;
};
/// ROS 1: the same values, little-endian, packed, strings without a NUL.
struct Ros1Packed {
  static constexpr bool kIsSwapped = false;
  static constexpr bool kIsAligned = false;
  static constexpr bool kHasTerminator = false;
};

/// A number at any address.
template <typename T, bool IsSwapped>
[[nodiscard]] T loadNumber(const std::byte* bytes) noexcept {
  std::byte raw[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    raw[i] = bytes[IsSwapped ? sizeof(T) - 1 - i : i];
  }
  return std::bit_cast<T>(raw);
}

/// Reads values off a serialised message, never past its end; `Format` is one of the above.
///
/// Every call says whether the bytes were there. Alignment counts from the first byte of the span. One thread.
template <typename Format>
class WireReader {
 public:
  /// Of `bytes` the first `there` may be read; the rest are yet to come.
  explicit WireReader(std::span<const std::byte> bytes, std::size_t there) noexcept : bytes_(bytes), there_(there) {}
  explicit WireReader(std::span<const std::byte> bytes) noexcept : WireReader(bytes, bytes.size()) {}

  [[nodiscard]] std::size_t left() const noexcept { return bytes_.size() - position_; }
  /// Size of the last value that did not fit.
  [[nodiscard]] std::uint64_t wanted() const noexcept { return wanted_; }

  /// `size` raw bytes, which need not be there yet.
  [[nodiscard]] bool take(std::uint64_t size, std::span<const std::byte>& out) noexcept {
    if (size > left()) {
      wanted_ = size;
      return false;
    }
    out = bytes_.subspan(position_, static_cast<std::size_t>(size));
    position_ += static_cast<std::size_t>(size);
    return true;
  }
  /// `size` raw bytes to be read now.
  [[nodiscard]] bool takeNow(std::uint64_t size, std::span<const std::byte>& out) noexcept {
    return take(size, out) && position_ <= there_;
  }
  /// Passes over `size` bytes that begin at a multiple of `alignment`.
  [[nodiscard]] bool skip(std::size_t alignment, std::uint64_t size) noexcept {
    std::span<const std::byte> ignored;
    return align(alignment) && take(size, ignored);
  }
  template <typename T>
  [[nodiscard]] bool number(T& out) noexcept {
    if (!align(sizeof(T)) || sizeof(T) > left() || position_ + sizeof(T) > there_) {
      wanted_ = sizeof(T);
      return false;
    }
    out = loadNumber<T, Format::kIsSwapped>(bytes_.data() + position_);
    position_ += sizeof(T);
    return true;
  }
  /// A view of the text, without its terminator.
  [[nodiscard]] bool text(std::string_view& out) noexcept {
    std::uint32_t length = 0;
    std::span<const std::byte> raw;
    if (!number(length) || !takeNow(length, raw)) {
      return false;
    }
    out = {reinterpret_cast<const char*>(raw.data()), raw.size()};
    if (Format::kHasTerminator && out.ends_with('\0')) {
      out.remove_suffix(1);
    }
    return true;
  }

 private:
  [[nodiscard]] bool align(std::size_t alignment) noexcept {
    if constexpr (Format::kIsAligned) {
      const std::size_t aligned = (position_ + alignment - 1) & ~(alignment - 1);
      if (aligned > bytes_.size()) {
        wanted_ = alignment;
        return false;
      }
      position_ = aligned;
    }
    return true;
  }

  std::span<const std::byte> bytes_;
  std::size_t there_;
  std::size_t position_ = 0;
  std::uint64_t wanted_ = 0;
};

}  // namespace stillframe::ingest
