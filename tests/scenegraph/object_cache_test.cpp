#include "scenegraph/store/object_cache.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <semaphore>
#include <thread>
#include <vector>

#include "scenegraph/stopwatch.h"
#include "scenegraph/thread_priority.h"

namespace stillframe::scenegraph {
namespace {

CacheKey key(std::int64_t time, const std::string& product = "object") {
  Entry entry;
  entry.log_time = tf::TimePoint{time};
  return cacheKey(1, entry, product);
}

std::shared_ptr<const int> number(int value) { return std::make_shared<const int>(value); }

TEST(ObjectCache, GivesBackWhatWasPut) {
  ObjectCache cache(100);
  EXPECT_EQ(cache.get<int>(key(1)), nullptr);
  cache.put(key(1), number(7), 10);
  EXPECT_EQ(*cache.get<int>(key(1)), 7);
  EXPECT_EQ(cache.get<int>(key(1, "points")), nullptr);
  EXPECT_EQ(cache.hits(), 1U);
  EXPECT_EQ(cache.misses(), 2U);
}

TEST(ObjectCache, DropsTheLeastRecentlyUsedFirst) {
  ObjectCache cache(30);
  cache.put(key(1), number(1), 10);
  cache.put(key(2), number(2), 10);
  cache.put(key(3), number(3), 10);
  (void)cache.get<int>(key(1));
  cache.put(key(4), number(4), 10);
  EXPECT_NE(cache.get<int>(key(1)), nullptr);
  EXPECT_EQ(cache.get<int>(key(2)), nullptr);
  EXPECT_EQ(cache.bytes(), 30U);
}

TEST(ObjectCache, ReplacesUnderTheSameKeyAndCountsItsBytesOnce) {
  ObjectCache cache(30);
  cache.put(key(1), number(1), 20);
  cache.put(key(1), number(2), 5);
  EXPECT_EQ(*cache.get<int>(key(1)), 2);
  EXPECT_EQ(cache.bytes(), 5U);
}

TEST(ObjectCache, KeepsNothingLargerThanItsBound) {
  ObjectCache cache(30);
  cache.put(key(1), number(1), 10);
  cache.put(key(2), number(2), 31);
  EXPECT_EQ(cache.get<int>(key(2)), nullptr);
  EXPECT_NE(cache.get<int>(key(1)), nullptr);
  cache.put(key(1), number(3), static_cast<std::size_t>(-1));
  EXPECT_EQ(cache.get<int>(key(1)), nullptr) << "the older product of the same key must not stay";
  EXPECT_EQ(cache.bytes(), 0U);
}

TEST(ObjectCache, ShrinksAtOnce) {
  ObjectCache cache(30);
  cache.put(key(1), number(1), 10);
  cache.put(key(2), number(2), 10);
  cache.setMaxBytes(10);
  EXPECT_EQ(cache.get<int>(key(1)), nullptr);
  EXPECT_NE(cache.get<int>(key(2)), nullptr);
  cache.setMaxBytes(0);
  EXPECT_EQ(cache.bytes(), 0U);
}

TEST(ObjectCache, AProductInUseOutlivesItsEviction) {
  ObjectCache cache(10);
  cache.put(key(1), number(1), 10);
  const auto in_use = cache.get<int>(key(1));
  cache.put(key(2), number(2), 10);
  EXPECT_EQ(*in_use, 1);
}

TEST(ObjectCache, WhatManyWantAtATimeIsMadeOnce) {
  ObjectCache cache(100);
  std::atomic<int> made = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&] {
      const ObjectCache::Claim claim(cache, key(1));
      if (cache.peek<int>(key(1)) == nullptr) {
        std::this_thread::yield();
        ++made;
        cache.put(key(1), number(1), 10);
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  EXPECT_EQ(made, 1);
  const ObjectCache::Claim one(cache, key(2));
  const ObjectCache::Claim other(cache, key(3));  // another key does not wait
  EXPECT_EQ(cache.misses(), 0U) << "looking whether another has made it counts for nothing";
}

TEST(ObjectCache, MayBeUsedFromManyThreads) {
  ObjectCache cache(100);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&cache, t] {
      for (int i = 0; i < 500; ++i) {
        cache.put(key(i % 20), number(i % 20), 10);
        const auto found = cache.get<int>(key((i + t) % 20));
        ASSERT_TRUE(found == nullptr || *found == (i + t) % 20);
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  EXPECT_LE(cache.bytes(), 100U);
}

TEST(ObjectCache, HasAThreadThatStandsBackGoOnWhereAnotherAwaitsItsProduct) {
  ObjectCache cache;
  const Precedence drawing;
  std::binary_semaphore is_claimed{0};
  double paused_ms = 0.0;
  std::thread ahead([&] {
    standBack(StandBack::Spare);
    const ObjectCache::Claim claim(cache, key(1));
    is_claimed.release();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // by now it is awaited
    for (int i = 0; i < 20; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      const auto start = std::chrono::steady_clock::now();
      giveWay();
      paused_ms += millisecondsSince(start);
    }
  });
  is_claimed.acquire();
  const ObjectCache::Claim wanted(cache, key(1));
  ahead.join();
  EXPECT_LT(paused_ms, 100.0) << "20 pauses are 200 ms";
}

}  // namespace
}  // namespace stillframe::scenegraph
