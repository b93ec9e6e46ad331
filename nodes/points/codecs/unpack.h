#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "nodes/points/codecs/cloudini_header.h"

struct ZSTD_DCtx_s;

namespace stillframe::nodes::cloudini {

/// Most that so many bytes can unpack to, whatever they are.
[[nodiscard]] std::uint64_t maxUnpackedBytes(Compression compression, std::uint64_t packed_bytes) noexcept;

/// Unpacks one chunk after the other into a buffer that it keeps. One thread at a time.
class Unpacker {
 public:
  explicit Unpacker(Compression compression);
  ~Unpacker();
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;

  /// The chunk's bytes, valid until the next call; with no compression they are `packed` itself. Fails beyond
  /// `max_bytes`; memory grows with what comes out. The error is half a sentence.
  [[nodiscard]] std::expected<std::span<const std::byte>, std::string> unpack(std::span<const std::byte> packed,
                                                                              std::uint64_t max_bytes);

 private:
  std::expected<std::span<const std::byte>, std::string> unpackLz4(std::span<const std::byte> packed,
                                                                   std::size_t max_bytes);
  std::expected<std::span<const std::byte>, std::string> unpackZstd(std::span<const std::byte> packed,
                                                                    std::size_t max_bytes);
  void reserve(std::size_t bytes, std::size_t keep);

  Compression compression_;
  std::unique_ptr<ZSTD_DCtx_s, std::size_t (*)(ZSTD_DCtx_s*)> zstd_;
  std::unique_ptr<std::byte[]> buffer_;
  std::size_t capacity_ = 0;
};

}  // namespace stillframe::nodes::cloudini
