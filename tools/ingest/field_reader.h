#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace stillframe::ingest {

/// Reads the little-endian fields of an MCAP record, never past its end.
///
/// A field that does not fit reads as zero or empty and makes isGood() false for good; check once at the end. Views
/// stay valid as long as the bytes. Little-endian hosts only (as all of Debian's desktop and robot platforms are).
class FieldReader {
 public:
  explicit FieldReader(std::span<const std::byte> bytes) noexcept : bytes_(bytes) {}

  template <std::integral T>
  [[nodiscard]] T number() noexcept {
    T value{};
    if (take(sizeof(T))) {
      std::memcpy(&value, bytes_.data() + position_ - sizeof(T), sizeof(T));
    }
    return value;
  }
  /// `size` bytes; empty when they are not there.
  [[nodiscard]] std::span<const std::byte> bytes(std::uint64_t size) noexcept {
    return take(size) ? bytes_.subspan(position_ - static_cast<std::size_t>(size), static_cast<std::size_t>(size))
                      : std::span<const std::byte>{};
  }
  /// Bytes behind a 32-bit length.
  [[nodiscard]] std::span<const std::byte> block() noexcept { return bytes(number<std::uint32_t>()); }
  /// Text behind a 32-bit length.
  [[nodiscard]] std::string_view string() noexcept {
    const auto text = block();
    return {reinterpret_cast<const char*>(text.data()), text.size()};
  }

  [[nodiscard]] std::size_t position() const noexcept { return position_; }
  [[nodiscard]] std::size_t left() const noexcept { return bytes_.size() - position_; }
  [[nodiscard]] bool isGood() const noexcept { return is_good_; }

 private:
  bool take(std::uint64_t size) noexcept {
    if (!is_good_ || size > left()) {
      is_good_ = false;
      return false;
    }
    position_ += static_cast<std::size_t>(size);
    return true;
  }

  std::span<const std::byte> bytes_;
  std::size_t position_ = 0;
  bool is_good_ = true;
};

}  // namespace stillframe::ingest
