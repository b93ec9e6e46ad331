#include "tools/ingest/compression.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace stillframe::ingest {
namespace {

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
  return {packed.size(), [=](std::size_t position) {
            return packed.first(there)
                .subspan(std::min(position, there))
                .first(std::min(piece, there - std::min(position, there)));
          }};
}

TEST(Compression, BytesThatComeInPiecesUnpackToTheSameWithTheirSum) {
  const auto bytes = someBytes(200'000);
  for (const Compression compression : {Compression::None, Compression::Lz4, Compression::Zstd}) {
    const auto packed = compress(compression, bytes);
    ASSERT_TRUE(packed);
    for (const std::size_t piece : {std::size_t{1000}, std::size_t{4096}, packed->size()}) {
      std::uint32_t crc = 0;
      const auto unpacked =
          decompress(compression, inPieces(*packed, piece, packed->size()), bytes.size(), Completeness::Whole,
                     [&](std::span<const std::byte> made) { crc = crc32(made, crc); });
      ASSERT_TRUE(unpacked) << unpacked.error();
      EXPECT_TRUE(std::ranges::equal(unpacked->bytes(), bytes)) << toString(compression) << " by " << piece;
      EXPECT_EQ(crc, crc32(bytes)) << toString(compression) << " by " << piece;
    }
  }
}

TEST(Compression, FewerBytesThanWereSaidAreAnErrorOrAPrefix) {
  const auto bytes = someBytes(1'000'000);
  for (const Compression compression : {Compression::None, Compression::Lz4, Compression::Zstd}) {
    const auto packed = compress(compression, bytes);
    ASSERT_TRUE(packed);
    const PackedBytes cut = inPieces(*packed, 1000, packed->size() / 2);
    const auto refused = decompress(compression, cut, bytes.size());
    ASSERT_FALSE(refused) << toString(compression);
    EXPECT_TRUE(refused.error().contains("1000000")) << refused.error();
    if (compression != Compression::None) {
      const auto prefix = decompress(compression, cut, bytes.size(), Completeness::Prefix);
      ASSERT_TRUE(prefix) << prefix.error();
      EXPECT_GT(prefix->size, 0U);
      EXPECT_TRUE(std::ranges::equal(prefix->bytes(), std::span(bytes).first(prefix->size)));
    }
  }
}

}  // namespace
}  // namespace stillframe::ingest
