#include "tools/ingest/chunk_cache.h"

#include <gtest/gtest.h>

#include <chrono>
#include <semaphore>
#include <thread>
#include <utility>

#include "scenegraph/stopwatch.h"
#include "scenegraph/thread_priority.h"

namespace stillframe::ingest {
namespace {

constexpr std::size_t kBound = 100;

/// Chunks of a size, and how often one was unpacked.
struct Unpacking {
  std::size_t bytes;
  int times = 0;

  std::function<ChunkCache::Chunk()> operator()() {
    return [this]() -> ChunkCache::Chunk {
      ++times;
      return makeBuffer(bytes);
    };
  }
};

TEST(ChunkCache, UnpacksAChunkOnceAndKeepsTheLastOnesWithinItsBound) {
  ChunkCache cache(kBound);
  Unpacking unpacking{.bytes = 40};
  for (const std::uint64_t key : {1U, 2U, 1U, 2U, 3U, 3U, 2U}) {
    ASSERT_TRUE(cache.get(key, unpacking())->has_value());
  }
  EXPECT_EQ(unpacking.times, 3);
  (void)cache.get(1, unpacking());
  EXPECT_EQ(unpacking.times, 4) << "the one that was not wanted for longest is gone";
}

TEST(ChunkCache, FindsAChunkThatItLetGoOfWhileSomebodyReadsIt) {
  ChunkCache cache(kBound);
  Unpacking unpacking{.bytes = 80};
  auto dropped = cache.get(1, unpacking());
  cache.drop(1);
  auto evicted = cache.get(2, unpacking());
  const auto newest = cache.get(3, unpacking());
  ASSERT_EQ(unpacking.times, 3);
  EXPECT_EQ(cache.get(1, unpacking()), dropped);
  EXPECT_EQ(cache.get(2, unpacking()), evicted);
  EXPECT_EQ(unpacking.times, 3);
  dropped = evicted = nullptr;
  (void)cache.get(1, unpacking());
  (void)cache.get(2, unpacking());
  EXPECT_EQ(unpacking.times, 5) << "nobody does any longer";
}

TEST(ChunkCache, RemembersWhatCannotBeUnpacked) {
  ChunkCache cache(kBound);
  int tries = 0;
  const auto fail = [&]() -> ChunkCache::Chunk {
    ++tries;
    return std::unexpected("it is damaged");
  };
  EXPECT_EQ(cache.get(1, fail)->error(), "it is damaged");
  EXPECT_FALSE(cache.get(1, fail)->has_value());
  EXPECT_EQ(tries, 1);
}

TEST(ChunkCache, HasAThreadThatStandsBackGoOnWhereAnotherAwaitsItsChunk) {
  ChunkCache cache(kBound);
  const scenegraph::Precedence drawing;
  std::binary_semaphore is_begun{0};
  double paused_ms = 0.0;
  std::thread loader([&] {
    scenegraph::standBack(scenegraph::StandBack::Spare);
    (void)cache.get(1, [&]() -> ChunkCache::Chunk {
      is_begun.release();
      std::this_thread::sleep_for(std::chrono::milliseconds(100));  // by now it is awaited
      for (int i = 0; i < 20; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        const auto start = std::chrono::steady_clock::now();
        scenegraph::giveWay();
        paused_ms += scenegraph::millisecondsSince(start);
      }
      return makeBuffer(1);
    });
  });
  is_begun.acquire();
  EXPECT_TRUE(cache.get(1, []() -> ChunkCache::Chunk { return std::unexpected("twice"); })->has_value());
  loader.join();
  EXPECT_LT(paused_ms, 100.0) << "20 pauses are 200 ms";
}

}  // namespace
}  // namespace stillframe::ingest
