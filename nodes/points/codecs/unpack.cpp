#include "nodes/points/codecs/unpack.h"

#include <lz4.h>
#include <zstd.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

namespace stillframe::nodes::cloudini {

using std::unexpected;

std::uint64_t maxUnpackedBytes(Compression compression, std::uint64_t packed_bytes) noexcept {
  switch (compression) {
    case Compression::None:
      return packed_bytes;
    case Compression::Lz4:
      return 255 * packed_bytes + 64;  // a byte of a match's length stands for 255 bytes
    case Compression::Zstd:
      return 32768 * packed_bytes;  // a block of one repeated byte: 128 KiB in 4 bytes
  }
  return 0;
}

Unpacker::Unpacker(Compression compression)
    : compression_(compression),
      zstd_(compression == Compression::Zstd ? ZSTD_createDCtx() : nullptr, &ZSTD_freeDCtx) {}

Unpacker::~Unpacker() = default;

std::expected<std::span<const std::byte>, std::string> Unpacker::unpack(std::span<const std::byte> packed,
                                                                        std::uint64_t max_bytes) {
  const auto limit = static_cast<std::size_t>(std::min(
      {max_bytes, maxUnpackedBytes(compression_, packed.size()), std::uint64_t{std::numeric_limits<int>::max()}}));
  switch (compression_) {
    case Compression::None:
      return packed;
    case Compression::Lz4:
      return unpackLz4(packed, limit);
    case Compression::Zstd:
      return unpackZstd(packed, limit);
  }
  return packed;
}

void Unpacker::reserve(std::size_t bytes, std::size_t keep) {
  if (capacity_ >= bytes) {
    return;
  }
  auto larger = std::make_unique_for_overwrite<std::byte[]>(bytes);
  if (keep > 0) {
    std::memcpy(larger.get(), buffer_.get(), keep);
  }
  buffer_ = std::move(larger);
  capacity_ = bytes;
}

std::expected<std::span<const std::byte>, std::string> Unpacker::unpackLz4(std::span<const std::byte> packed,
                                                                           std::size_t max_bytes) {
  if (packed.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    return unexpected("is too large for lz4");
  }
  reserve(max_bytes, 0);
  const int size =
      LZ4_decompress_safe(reinterpret_cast<const char*>(packed.data()), reinterpret_cast<char*>(buffer_.get()),
                          static_cast<int>(packed.size()), static_cast<int>(max_bytes));
  if (size < 0) {
    return unexpected("cannot be unpacked: its lz4 data is corrupt or too long");
  }
  return std::span(buffer_.get(), static_cast<std::size_t>(size));
}

std::expected<std::span<const std::byte>, std::string> Unpacker::unpackZstd(std::span<const std::byte> packed,
                                                                            std::size_t max_bytes) {
  // A frame may ask for a window of any size; none larger than what comes out is of use.
  const int window_log = std::clamp(static_cast<int>(std::bit_width(max_bytes)), 20, 27);
  ZSTD_DCtx_reset(zstd_.get(), ZSTD_reset_session_and_parameters);
  ZSTD_DCtx_setParameter(zstd_.get(), ZSTD_d_windowLogMax, window_log);
  const unsigned long long claimed = ZSTD_getFrameContentSize(packed.data(), packed.size());
  const bool is_known = claimed != ZSTD_CONTENTSIZE_UNKNOWN && claimed != ZSTD_CONTENTSIZE_ERROR;
  if (is_known && claimed > max_bytes) {
    return unexpected("claims " + std::to_string(claimed) + " unpacked bytes, at most " + std::to_string(max_bytes) +
                      " make sense");
  }
  reserve(std::max<std::size_t>(1, std::min({max_bytes, std::max<std::size_t>(64 * packed.size(), 1 << 16),
                                             is_known ? static_cast<std::size_t>(claimed) : max_bytes})),
          0);
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  ZSTD_outBuffer out{buffer_.get(), capacity_, 0};
  while (true) {
    const std::size_t left = ZSTD_decompressStream(zstd_.get(), &out, &in);
    if (ZSTD_isError(left) != 0) {
      return unexpected("cannot be unpacked: " + std::string(ZSTD_getErrorName(left)));
    }
    if (left == 0) {
      break;
    }
    if (out.pos < out.size) {
      return unexpected("cannot be unpacked: its zstd data ends too early");
    }
    if (capacity_ >= max_bytes) {
      return unexpected("unpacks to more than " + std::to_string(max_bytes) + " bytes");
    }
    reserve(std::min(max_bytes, 2 * capacity_), out.pos);
    out.dst = buffer_.get();
    out.size = capacity_;
  }
  if (in.pos != in.size) {
    return unexpected("has bytes behind its zstd frame");
  }
  return std::span(buffer_.get(), out.pos);
}

}  // namespace stillframe::nodes::cloudini
