#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace stillframe::ingest {

/// Byte order of a message.
enum class ByteOrder : std::uint8_t { Little, Big };

/// Writes one ROS 2 message as CDR (XCDR1, as every ROS 2 middleware records it), field by field.
///
/// Fields align to their own size, counted from behind the 4-byte encapsulation header; strings end with a NUL that
/// counts. One thread.
class CdrWriter {
 public:
  explicit CdrWriter(ByteOrder order = ByteOrder::Little) : order_(order) {
    bytes_ = {std::byte{0}, order == ByteOrder::Little ? std::byte{1} : std::byte{0}, std::byte{0}, std::byte{0}};
  }

  template <typename T>
    requires std::is_arithmetic_v<T>
  CdrWriter& number(T value) {
    while ((bytes_.size() - kHeaderBytes) % sizeof(T) != 0) {
      bytes_.push_back(std::byte{0});
    }
    std::byte raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes_.push_back(raw[order_ == ByteOrder::Little ? i : sizeof(T) - 1 - i]);
    }
    return *this;
  }
  CdrWriter& string(std::string_view text) {
    length(text.size() + 1);
    raw(std::as_bytes(std::span(text)));
    bytes_.push_back(std::byte{0});
    return *this;
  }
  /// Number of elements of the sequence that follows.
  CdrWriter& length(std::size_t count) { return number(static_cast<std::uint32_t>(count)); }
  /// A whole sequence of bytes: uint8[].
  CdrWriter& byteSequence(std::span<const std::byte> bytes) {
    length(bytes.size());
    return raw(bytes);
  }
  /// std_msgs/Header: stamp and frame. The stamp is nanoseconds since the epoch and must lie in 1902..2038.
  CdrWriter& header(std::int64_t stamp_ns, std::string_view frame_id) { return stamp(stamp_ns).string(frame_id); }
  /// builtin_interfaces/Time.
  CdrWriter& stamp(std::int64_t stamp_ns) {
    constexpr std::int64_t kSecond = 1'000'000'000;
    const std::int64_t below = stamp_ns % kSecond < 0 ? 1 : 0;
    const std::int64_t seconds = stamp_ns / kSecond - below;
    number(static_cast<std::int32_t>(seconds));
    return number(static_cast<std::uint32_t>(stamp_ns - seconds * kSecond));
  }

  [[nodiscard]] const std::vector<std::byte>& bytes() const noexcept { return bytes_; }

 private:
  static constexpr std::size_t kHeaderBytes = 4;
  CdrWriter& raw(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
  }

  ByteOrder order_;
  std::vector<std::byte> bytes_;
};

}  // namespace stillframe::ingest
