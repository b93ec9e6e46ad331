#include "tools/ingest/compression.h"

#include <libdeflate.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>

#include "scenegraph/store/large_pages.h"
#include "tools/ingest/sentence.h"
#include "tools/ingest/unpack_helper.h"

namespace stillframe::ingest {

namespace {

constexpr std::uint64_t kAlwaysPlausible = std::uint64_t{64} << 20;
constexpr std::uint64_t kMaxChunkBytes = (std::uint64_t{1} << 31) - 1;  // a locator holds 31 bits of offset
constexpr std::uint64_t kPlausibleRatio = 64;

/// One step of a streaming decompressor.
struct Step {
  std::size_t consumed = 0;
  std::size_t produced = 0;
  bool is_finished = false;
  const char* error = nullptr;
};

struct ZstdStream {
  std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context{ZSTD_createDCtx(), &ZSTD_freeDCtx};

  Step step(std::span<const std::byte> in, std::span<std::byte> out) {
    ZSTD_inBuffer input{in.data(), in.size(), 0};
    ZSTD_outBuffer output{out.data(), out.size(), 0};
    const std::size_t result = ZSTD_decompressStream(context.get(), &output, &input);
    if (ZSTD_isError(result) != 0u) {
      return {input.pos, output.pos, false, ZSTD_getErrorName(result)};
    }
    return {input.pos, output.pos, result == 0, nullptr};
  }
};

struct Lz4Stream {
  struct Free {
    void operator()(LZ4F_dctx* freed) const { LZ4F_freeDecompressionContext(freed); }
  };
  std::unique_ptr<LZ4F_dctx, Free> context;

  Lz4Stream() {
    LZ4F_dctx* raw = nullptr;
    if (LZ4F_isError(LZ4F_createDecompressionContext(&raw, LZ4F_VERSION)) == 0u) {
      context.reset(raw);
    }
  }
  Step step(std::span<const std::byte> in, std::span<std::byte> out) {
    std::size_t consumed = in.size();
    std::size_t produced = out.size();
    const std::size_t result = LZ4F_decompress(context.get(), out.data(), &produced, in.data(), &consumed, nullptr);
    if (LZ4F_isError(result) != 0u) {
      return {0, 0, false, LZ4F_getErrorName(result)};
    }
    return {consumed, produced, result == 0, nullptr};
  }
};

Buffer grown(const Buffer& old, std::size_t used, std::size_t size) {
  Buffer buffer = makeBuffer(size);
  std::memcpy(buffer.data.get(), old.data.get(), used);
  return buffer;
}

template <typename Stream>
std::expected<Buffer, std::string> unpack(const PackedBytes& packed, std::size_t claimed, const Unpacking& unpacking) {
  Stream stream;
  if (stream.context == nullptr) {
    return std::unexpected("no memory for a decompressor");
  }
  // One byte more than claimed, so that a stream that holds more shows itself.
  const std::size_t limit = claimed + 1;
  const bool is_plausible = claimed <= packed.size * kPlausibleRatio;
  std::size_t capacity = is_plausible ? limit : std::min<std::size_t>(limit, packed.size * kPlausibleRatio + 4096);
  Buffer out = unpacking.room(capacity);
  if (is_plausible) {
    unpacking.begun(out);
  }
  auto helper = unpacking.has_helper && is_plausible
                    ? UnpackHelper::start(packed, unpacking.made, std::span(out.data.get(), capacity))
                    : nullptr;
  PackedWindow window(packed);
  std::size_t used = 0;
  std::size_t position = 0;
  bool is_finished = false;
  const char* error = nullptr;
  while (error == nullptr) {
    if (used == capacity && capacity < limit) {
      capacity = std::min(limit, capacity * 2);
      out = grown(out, used, capacity);
    }
    unpacking.pause();
    const auto in = helper ? helper->from(position) : window.from(position);
    const Step step = stream.step(in, {out.data.get() + used, capacity - used});
    position += step.consumed;
    used += step.produced;
    if (helper) {
      helper->made(used);
    } else {
      unpacking.made({out.data.get() + used - step.produced, step.produced});
    }
    is_finished = step.is_finished;
    error = step.error;
    if (used == limit || (is_finished && position == packed.size) || (step.consumed == 0 && step.produced == 0)) {
      break;
    }
  }
  helper.reset();
  if (used > claimed) {
    return std::unexpected(sentence("it holds more than the ", claimed, " bytes it claims"));
  }
  if (unpacking.completeness == Completeness::Whole) {
    if (error != nullptr) {
      return std::unexpected(sentence("its data cannot be unpacked: ", error));
    }
    if (used != claimed || !is_finished) {
      return std::unexpected(sentence("it claims ", claimed, " bytes but unpacks to ", used));
    }
  }
  out.size = used;
  return out;
}

/// Not packed at all.
std::expected<Buffer, std::string> copy(const PackedBytes& packed, std::size_t claimed, const Unpacking& unpacking) {
  Buffer out = unpacking.room(claimed);
  unpacking.begun(out);
  for (std::size_t used = 0; used < claimed;) {
    unpacking.pause();
    const std::size_t taken = packed.read(
        used, std::span(out.data.get(), claimed).subspan(used, std::min(PackedWindow::kBytes, claimed - used)));
    if (taken == 0) {
      return std::unexpected(sentence("it claims ", claimed, " bytes but holds ", used));
    }
    unpacking.made({out.data.get() + used, taken});
    used += taken;
  }
  return out;
}

}  // namespace

Buffer makeBuffer(std::size_t size) {
  Buffer buffer{std::make_shared_for_overwrite<std::byte[]>(size), size};
  scenegraph::useLargePages(buffer.data.get(), size);
  return buffer;
}

std::optional<Compression> compressionFromName(std::string_view name) noexcept {
  if (name.empty()) {
    return Compression::None;
  }
  if (name == "lz4") {
    return Compression::Lz4;
  }
  if (name == "zstd") {
    return Compression::Zstd;
  }
  return std::nullopt;
}

std::string_view toString(Compression compression) noexcept {
  switch (compression) {
    case Compression::None:
      return "";
    case Compression::Lz4:
      return "lz4";
    case Compression::Zstd:
      return "zstd";
  }
  return "";
}

std::uint64_t maxUnpackedBytes(Compression compression, std::uint64_t packed_bytes) noexcept {
  const std::uint64_t packed = std::min(packed_bytes, kMaxChunkBytes);
  switch (compression) {
    case Compression::None:
      return packed;
    case Compression::Lz4:
      return std::min(kMaxChunkBytes, packed * 255);
    case Compression::Zstd:
      return std::min(kMaxChunkBytes, std::max(kAlwaysPlausible, packed * 1024));
  }
  return 0;
}

std::expected<Buffer, std::string> decompress(Compression compression, const PackedBytes& packed,
                                              std::uint64_t claimed_bytes, const Unpacking& unpacking) {
  const std::uint64_t limit = maxUnpackedBytes(compression, packed.size);
  const bool is_prefix = unpacking.completeness == Completeness::Prefix;
  if (claimed_bytes > limit && !(is_prefix && claimed_bytes <= kMaxChunkBytes)) {
    return std::unexpected(sentence("it claims ", claimed_bytes, " bytes, which ", packed.size, " bytes of ",
                                    compression == Compression::None ? "uncompressed" : toString(compression),
                                    " data cannot hold"));
  }
  const auto claimed = static_cast<std::size_t>(is_prefix ? std::min(claimed_bytes, limit) : claimed_bytes);
  switch (compression) {
    case Compression::Lz4:
      return unpack<Lz4Stream>(packed, claimed, unpacking);
    case Compression::Zstd:
      return unpack<ZstdStream>(packed, claimed, unpacking);
    case Compression::None:
      break;
  }
  if (!is_prefix && packed.size != claimed) {
    return std::unexpected(sentence("it claims ", claimed, " bytes but holds ", packed.size));
  }
  return copy(packed, claimed, unpacking);
}

std::expected<std::vector<std::byte>, std::string> compress(Compression compression, std::span<const std::byte> bytes) {
  std::vector<std::byte> out;
  std::size_t written = bytes.size();
  switch (compression) {
    case Compression::None:
      out.assign(bytes.begin(), bytes.end());
      return out;
    case Compression::Lz4:
      out.resize(LZ4F_compressFrameBound(bytes.size(), nullptr));
      written = LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr);
      if (LZ4F_isError(written) != 0u) {
        return std::unexpected(std::string(LZ4F_getErrorName(written)));
      }
      break;
    case Compression::Zstd:
      out.resize(ZSTD_compressBound(bytes.size()));
      written = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 1);
      if (ZSTD_isError(written) != 0u) {
        return std::unexpected(std::string(ZSTD_getErrorName(written)));
      }
      break;
  }
  out.resize(written);
  return out;
}

std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t crc) noexcept {
  return bytes.empty() ? crc : ::libdeflate_crc32(crc, bytes.data(), bytes.size());
}

}  // namespace stillframe::ingest
