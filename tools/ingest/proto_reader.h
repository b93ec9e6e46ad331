#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>

namespace stillframe::ingest {

/// Reads tags and values of the protobuf wire format, never past the end of the span. Groups are refused. One thread.
class ProtoReader {
 public:
  enum class Type : std::uint8_t { Varint = 0, Fixed64 = 1, Length = 2, Fixed32 = 5 };
  struct Tag {
    std::uint32_t number = 0;
    Type type = Type::Varint;
  };
  struct Value {
    std::uint64_t number = 0;          ///< the bits, unless Length
    std::span<const std::byte> bytes;  ///< Length
  };

  explicit ProtoReader(std::span<const std::byte> bytes) noexcept : bytes_(bytes) {}

  [[nodiscard]] bool isAtEnd() const noexcept { return position_ == bytes_.size(); }
  [[nodiscard]] std::size_t left() const noexcept { return bytes_.size() - position_; }
  /// Size of the last value that did not fit; 0 when the bytes are wrong rather than missing.
  [[nodiscard]] std::uint64_t wanted() const noexcept { return wanted_; }

  [[nodiscard]] std::optional<Tag> tag() noexcept {
    const auto bits = varint();
    if (!bits) {
      return std::nullopt;
    }
    if (*bits >> 3 == 0 || *bits >> 32 != 0) {
      wanted_ = 0;
      return std::nullopt;
    }
    return Tag{static_cast<std::uint32_t>(*bits >> 3), static_cast<Type>(*bits & 7u)};
  }
  [[nodiscard]] std::optional<Value> value(Type type) noexcept {
    switch (type) {
      case Type::Varint: {
        const auto bits = varint();
        return bits ? std::optional(Value{*bits, {}}) : std::nullopt;
      }
      case Type::Fixed64:
        return fixed<std::uint64_t>();
      case Type::Fixed32:
        return fixed<std::uint32_t>();
      case Type::Length: {
        const auto length = varint();
        if (!length || !fits(*length)) {
          return std::nullopt;
        }
        position_ += static_cast<std::size_t>(*length);
        return Value{0,
                     bytes_.subspan(position_ - static_cast<std::size_t>(*length), static_cast<std::size_t>(*length))};
      }
    }
    wanted_ = 0;
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool fits(std::uint64_t size) noexcept {
    wanted_ = size;
    return size <= left();
  }
  template <typename T>
  [[nodiscard]] std::optional<Value> fixed() noexcept {
    if (!fits(sizeof(T))) {
      return std::nullopt;
    }
    T number{};
    std::memcpy(&number, bytes_.data() + position_, sizeof(T));
    position_ += sizeof(T);
    return Value{number, {}};
  }
  [[nodiscard]] std::optional<std::uint64_t> varint() noexcept {
    std::uint64_t result = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      if (!fits(1)) {
        return std::nullopt;
      }
      const auto byte = std::to_integer<std::uint64_t>(bytes_[position_++]);
      result |= (byte & 0x7Fu) << shift;
      if (byte < 0x80u) {
        return result;
      }
    }
    wanted_ = 0;  // more than ten bytes
    return std::nullopt;
  }

  std::span<const std::byte> bytes_;
  std::size_t position_ = 0;
  std::uint64_t wanted_ = 0;
};

}  // namespace stillframe::ingest
