#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stillframe::ingest {

/// How the records of a chunk are packed.
enum class Compression : std::uint8_t {
  None,  ///< ""
  Lz4,   ///< "lz4": the frame format
  Zstd,  ///< "zstd"
};

/// The compression an MCAP names; nullopt for one that is not known here.
[[nodiscard]] std::optional<Compression> compressionFromName(std::string_view name) noexcept;
[[nodiscard]] std::string_view toString(Compression compression) noexcept;

/// Bytes without the cost of clearing them first.
struct Buffer {
  std::shared_ptr<std::byte[]> data;
  std::size_t size = 0;
  [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return {data.get(), size}; }
};

[[nodiscard]] Buffer makeBuffer(std::size_t size);

/// Largest size a chunk of `packed_bytes` may claim: what the method can produce at best (255-fold for lz4), at most
/// 1024-fold but always 64 MiB for zstd, and never 2 GiB or more.
[[nodiscard]] std::uint64_t maxUnpackedBytes(Compression compression, std::uint64_t packed_bytes) noexcept;

/// Whether bytes may be missing at the end of what is unpacked.
enum class Completeness : std::uint8_t {
  Whole,   ///< anything but exactly the claimed size is an error
  Prefix,  ///< as much as can be unpacked of a chunk that was cut off
};

/// Packed bytes that need not be in memory all at once.
struct PackedBytes {
  std::size_t size = 0;
  /// Copies some of those from a position on, and says how many; none where there are fewer than was said.
  std::function<std::size_t(std::size_t position, std::span<std::byte> into)> read;
};

/// What else decompress() is to do.
struct Unpacking {
  Completeness completeness = Completeness::Whole;
  /// Makes the memory for it.
  std::function<Buffer(std::size_t)> room = &makeBuffer;
  /// Given the memory that all comes out into, before the first piece; not where it may yet have to move, because far
  /// less is packed than claimed.
  std::function<void(const Buffer&)> begun = [](const Buffer&) {};
  /// Given each piece that comes out, once and in order.
  std::function<void(std::span<const std::byte>)> made = [](std::span<const std::byte>) {};
  /// Called between pieces, on the caller's thread.
  std::function<void()> pause = [] {};
  /// Whether a thread of its own does what goes beside: reads ahead, touches memory ahead, and hands on what was made.
  /// Where unpacking is all there is to wait for it takes a fifth less then. `read` and `made` are called there.
  bool has_helper = false;
};

/// Unpacks a chunk that claims to hold `claimed_bytes`. Any thread.
///
/// A claim beyond maxUnpackedBytes() is refused at once; beneath it memory grows with what is really produced when the
/// claim is more than 64 times what is packed. The error is half a sentence with the byte counts.
[[nodiscard]] std::expected<Buffer, std::string> decompress(Compression compression, const PackedBytes& packed,
                                                            std::uint64_t claimed_bytes,
                                                            const Unpacking& unpacking = {});

[[nodiscard]] std::expected<std::vector<std::byte>, std::string> compress(Compression compression,
                                                                          std::span<const std::byte> bytes);

/// CRC-32 as MCAP uses it (zlib's), continued from `crc`.
[[nodiscard]] std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t crc = 0) noexcept;

}  // namespace stillframe::ingest
