#include "tools/ingest/compression.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "tools/ingest/sentence.h"

namespace stillframe::ingest {
namespace {

constexpr std::size_t kWindow = std::size_t{256} << 10;  // that is read at a time

/// Half noise, half none.
std::vector<std::byte> someBytes(std::size_t size) {
  std::mt19937 random(5);
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) {
    bytes[i] = i % 4096 < 2048 ? static_cast<std::byte>(random()) : std::byte{7};
  }
  return bytes;
}

/// In pieces of at most `piece` bytes, of which there are no more than `there`.
PackedBytes inPieces(std::span<const std::byte> packed, std::size_t piece, std::size_t there) {
  return {packed.size(), [=](std::size_t position, std::span<std::byte> into) {
            const auto rest = packed.first(there).subspan(std::min(position, there));
            const std::size_t size = std::min({piece, rest.size(), into.size()});
            std::ranges::copy(rest.first(size), into.begin());
            return size;
          }};
}

TEST(Compression, BytesThatComeInPiecesUnpackToTheSameWithTheirSum) {
  const auto bytes = someBytes(2'000'000);
  for (const Compression compression : {Compression::None, Compression::Lz4, Compression::Zstd}) {
    const auto packed = compress(compression, bytes);
    ASSERT_TRUE(packed);
    for (const std::size_t piece : {std::size_t{1000}, std::size_t{4096}, packed->size()}) {
      for (const bool has_helper : {false, true}) {
        std::uint32_t crc = 0;
        int pauses = 0;
        const auto unpacked = decompress(compression, inPieces(*packed, piece, packed->size()), bytes.size(),
                                         {.made = [&](std::span<const std::byte> made) { crc = crc32(made, crc); },
                                          .pause = [&] { ++pauses; },
                                          .has_helper = has_helper});
        ASSERT_TRUE(unpacked) << unpacked.error();
        const std::string which = sentence(toString(compression), " by ", piece, has_helper ? ", helped" : "");
        EXPECT_TRUE(std::ranges::equal(unpacked->bytes(), bytes)) << which;
        EXPECT_EQ(crc, crc32(bytes)) << which;
        EXPECT_GE(pauses, static_cast<int>(packed->size() / std::min(piece, kWindow))) << which;
      }
    }
  }
}

TEST(Compression, FewerBytesThanWereSaidAreAnErrorOrAPrefix) {
  const auto bytes = someBytes(1'000'000);
  for (const Compression compression : {Compression::None, Compression::Lz4, Compression::Zstd}) {
    const auto packed = compress(compression, bytes);
    ASSERT_TRUE(packed);
    const PackedBytes cut = inPieces(*packed, 1000, packed->size() / 2);
    for (const bool has_helper : {false, true}) {
      const auto refused = decompress(compression, cut, bytes.size(), {.has_helper = has_helper});
      ASSERT_FALSE(refused) << toString(compression);
      EXPECT_TRUE(refused.error().contains("1000000")) << refused.error();
      if (compression != Compression::None) {
        const auto prefix = decompress(compression, cut, bytes.size(),
                                       {.completeness = Completeness::Prefix, .has_helper = has_helper});
        ASSERT_TRUE(prefix) << prefix.error();
        EXPECT_GT(prefix->size, 0U);
        EXPECT_TRUE(std::ranges::equal(prefix->bytes(), std::span(bytes).first(prefix->size)));
      }
    }
  }
}

}  // namespace
}  // namespace stillframe::ingest
