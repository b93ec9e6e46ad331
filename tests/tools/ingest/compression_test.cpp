#include "tools/ingest/compression.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "tools/ingest/buffer_shelf.h"
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

TEST(Compression, TellsWhereAllComesOutBeforeItDoes) {
  const auto bytes = someBytes(1'000'000);
  const std::vector<std::byte> zeros(1'000'000);  // packed so far that the claim alone says nothing
  for (const Compression compression : {Compression::None, Compression::Lz4, Compression::Zstd}) {
    const std::byte* began = nullptr;
    std::size_t made_before = 0;
    const Unpacking unpacking{.begun = [&](const Buffer& out) { began = out.data.get(); },
                              .made = [&](std::span<const std::byte>) { made_before += began == nullptr ? 1 : 0; }};
    const auto packed = compress(compression, bytes);
    const auto unpacked = decompress(compression, inPieces(*packed, 4096, packed->size()), bytes.size(), unpacking);
    ASSERT_TRUE(unpacked);
    EXPECT_EQ(began, unpacked->data.get()) << toString(compression);
    EXPECT_EQ(made_before, 0U);
    if (compression != Compression::None) {
      began = nullptr;
      const auto all_zero = compress(compression, zeros);
      const auto packed_zeros = inPieces(*all_zero, 4096, all_zero->size());
      EXPECT_TRUE(decompress(compression, packed_zeros, zeros.size(), unpacking));
      EXPECT_EQ(began, nullptr) << "it may have to move: " << toString(compression);
    }
  }
}

TEST(BufferShelf, GivesLargeMemoryOutAgain) {
  const auto shelf = std::make_shared<BufferShelf>();
  constexpr std::size_t kMib = std::size_t{1} << 20;
  const auto placeOf = [&](std::size_t size) { return shelf->take(size).data.get(); };
  std::byte* const large = placeOf(40 * kMib);
  EXPECT_EQ(placeOf(40 * kMib), large);
  EXPECT_EQ(placeOf(25 * kMib), large);
  const Buffer held = shelf->take(40 * kMib);
  EXPECT_EQ(held.data.get(), large) << "all of what was given back, though less of it was used";
  const Buffer other = shelf->take(40 * kMib);
  EXPECT_NE(other.data.get(), large);
  EXPECT_NE(placeOf(kMib), large);
}

}  // namespace
}  // namespace stillframe::ingest
