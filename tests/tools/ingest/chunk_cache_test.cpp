#include "tools/ingest/chunk_cache.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <semaphore>
#include <thread>
#include <utility>

#include "scenegraph/thread_priority.h"

namespace stillframe::ingest {
namespace {

constexpr std::size_t kBound = 100;

/// Chunks of a size, and how often one was unpacked.
struct Unpacking {
  std::size_t bytes;
  int times = 0;

  ChunkCache::Unpack operator()() {
    return [this](const std::atomic<bool>&) -> ChunkCache::Chunk {
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
  const auto fail = [&](const std::atomic<bool>&) -> ChunkCache::Chunk {
    ++tries;
    return std::unexpected("it is damaged");
  };
  EXPECT_EQ(cache.get(1, fail)->error(), "it is damaged");
  EXPECT_FALSE(cache.get(1, fail)->has_value());
  EXPECT_EQ(tries, 1);
}

TEST(ChunkCache, SaysWhileItUnpacksThatAnotherThreadAwaitsTheChunk) {
  ChunkCache cache(kBound);
  std::binary_semaphore is_begun{0};
  bool was_awaited_at_first = true;
  bool is_awaited_at_last = false;
  std::thread loader([&] {
    scenegraph::standBack(scenegraph::StandBack::Loading);
    (void)cache.get(1, [&](const std::atomic<bool>& is_awaited) -> ChunkCache::Chunk {
      was_awaited_at_first = is_awaited;
      is_begun.release();
      for (int i = 0; i < 10'000 && !is_awaited; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      is_awaited_at_last = is_awaited;
      return makeBuffer(1);
    });
  });
  is_begun.acquire();
  EXPECT_TRUE(cache.get(1, [](const std::atomic<bool>&) -> ChunkCache::Chunk { return std::unexpected("twice"); })
                  ->has_value());
  loader.join();
  EXPECT_FALSE(was_awaited_at_first);
  EXPECT_TRUE(is_awaited_at_last);
}

}  // namespace
}  // namespace stillframe::ingest
