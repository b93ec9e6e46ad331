#include "tools/ingest/chunk_cache.h"

#include <gtest/gtest.h>

#include <chrono>
#include <new>
#include <semaphore>
#include <thread>
#include <utility>

#include "scenegraph/stopwatch.h"
#include "scenegraph/thread_priority.h"

namespace stillframe::ingest {
namespace {

using scenegraph::Arrival;

constexpr std::size_t kBound = 100;

/// Chunks of a size, and how often one was unpacked.
struct CountedUnpacking {
  std::size_t bytes;
  int times = 0;

  std::function<ChunkCache::Chunk(Arrival&)> operator()() {
    return [this](Arrival&) -> ChunkCache::Chunk {
      ++times;
      return makeBuffer(bytes);
    };
  }
};

TEST(ChunkCache, UnpacksAChunkOnceAndKeepsTheLastOnesWithinItsBound) {
  ChunkCache cache(kBound);
  CountedUnpacking unpacking{.bytes = 40};
  for (const std::uint64_t key : {1U, 2U, 1U, 2U, 3U, 3U, 2U}) {
    ASSERT_TRUE(cache.get(key, unpacking())->has_value());
  }
  EXPECT_EQ(unpacking.times, 3);
  (void)cache.get(1, unpacking());
  EXPECT_EQ(unpacking.times, 4) << "the one that was not wanted for longest is gone";
}

TEST(ChunkCache, FindsAChunkThatItLetGoOfWhileSomebodyReadsIt) {
  ChunkCache cache(kBound);
  CountedUnpacking unpacking{.bytes = 80};
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
  const auto fail = [&](Arrival&) -> ChunkCache::Chunk {
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
    (void)cache.get(1, [&](Arrival&) -> ChunkCache::Chunk {
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
  EXPECT_TRUE(cache.get(1, [](Arrival&) -> ChunkCache::Chunk { return std::unexpected("twice"); })->has_value());
  loader.join();
  EXPECT_LT(paused_ms, 100.0) << "20 pauses are 200 ms";
}

/// A chunk of two bytes, of which the second comes when it is let: `ends` well, or not.
struct SlowUnpacking {
  bool ends = true;
  std::binary_semaphore goes_on{0};
  int times = 0;

  std::function<ChunkCache::Chunk(Arrival&)> operator()() {
    return [this](Arrival& arrival) -> ChunkCache::Chunk {
      ++times;
      Buffer chunk = makeBuffer(2);
      arrival.begin({chunk.bytes(), chunk.data});
      chunk.data[0] = std::byte{1};
      arrival.advance(1);
      goes_on.acquire();
      chunk.data[1] = std::byte{2};
      arrival.advance(2);
      return ends ? ChunkCache::Chunk(chunk) : std::unexpected("its CRC is wrong");
    };
  }
};

TEST(ChunkCache, GivesAChunkWhileAThreadOfItsOwnUnpacksIt) {
  ChunkCache cache(kBound);
  SlowUnpacking unpacking;
  auto early = cache.getEarly(1, unpacking());
  ASSERT_TRUE(early);
  EXPECT_NE(early->writer, nullptr);
  const auto block = early->arrival->block();
  ASSERT_TRUE(block);
  ASSERT_EQ(early->arrival->wait(1), 1U);
  EXPECT_EQ(block->bytes[0], std::byte{1});
  unpacking.goes_on.release();
  ASSERT_EQ(early->arrival->wait(2), 2U);
  EXPECT_EQ(block->bytes[1], std::byte{2});
  EXPECT_TRUE(early->arrival->waitForAll());
  EXPECT_EQ((*cache.get(1, unpacking()))->data, block->owner) << "the same memory";
  EXPECT_EQ(unpacking.times, 1);
  EXPECT_FALSE(cache.getEarly(1, unpacking())) << "it is there";
}

TEST(ChunkCache, GivesAChunkThatAnotherThreadUnpacksAlready) {
  ChunkCache cache(kBound);
  SlowUnpacking unpacking;
  std::binary_semaphore is_begun{0};
  std::thread loader([&] {
    (void)cache.get(1, [&, unpack = unpacking()](Arrival& arrival) {
      is_begun.release();
      return unpack(arrival);
    });
  });
  is_begun.acquire();
  const auto early = cache.getEarly(1, unpacking());
  ASSERT_TRUE(early);
  EXPECT_EQ(early->writer, nullptr);
  EXPECT_EQ(early->arrival->wait(1), 1U);
  unpacking.goes_on.release();
  EXPECT_TRUE(early->arrival->waitForAll());
  loader.join();
  EXPECT_EQ(unpacking.times, 1);
}

TEST(ChunkCache, SaysThatAChunkGivenEarlyCameToNoGoodEndAndKeepsItsMemoryForWhoReadsIt) {
  ChunkCache cache(kBound);
  SlowUnpacking unpacking{.ends = false};
  const auto early = cache.getEarly(1, unpacking());
  ASSERT_TRUE(early);
  const auto block = early->arrival->block();
  ASSERT_TRUE(block);
  unpacking.goes_on.release();
  EXPECT_FALSE(early->arrival->waitForAll());
  EXPECT_FALSE(early->arrival->wait(1)) << "not even what was there";
  EXPECT_EQ(block->bytes[0], std::byte{1});
  EXPECT_EQ(cache.get(1, unpacking())->error(), "its CRC is wrong");
  EXPECT_FALSE(cache.getEarly(1, unpacking()));
}

TEST(ChunkCache, LetsNobodyWaitForAChunkWhoseUnpackingGaveUp) {
  ChunkCache cache(kBound);
  const auto gives_up = [](Arrival&) -> ChunkCache::Chunk { throw std::bad_alloc(); };
  EXPECT_FALSE(cache.getEarly(1, gives_up)) << "before there was anything";
  EXPECT_THROW((void)cache.get(1, gives_up), std::bad_alloc) << "who wants all of it is told";
  CountedUnpacking unpacking{.bytes = 1};
  EXPECT_TRUE(cache.get(1, unpacking())->has_value()) << "it is tried anew";
}

}  // namespace
}  // namespace stillframe::ingest
