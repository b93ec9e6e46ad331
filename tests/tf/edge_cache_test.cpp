#include "tf/edge_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <vector>

#include "tf_builders.h"

namespace stillframe::tf {
namespace {

/// Samples of ascending stamps; the pose tells which one it is.
EdgeCache cacheOf(const std::vector<std::int64_t>& stamps) {
  EdgeCache cache;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    cache.insert(TimePoint{stamps[i]}, translate(static_cast<double>(i), 0, 0));
  }
  return cache;
}

void expectMatchesUpperBound(const EdgeCache& cache, const std::vector<std::int64_t>& stamps, std::int64_t stamp) {
  const auto after = std::upper_bound(stamps.begin(), stamps.end(), stamp);
  const EdgeCache::Sample* found = cache.find(TimePoint{stamp});
  ASSERT_EQ(found == nullptr, after == stamps.begin()) << stamp << " in " << stamps.size() << " stamps";
  if (found != nullptr) {
    ASSERT_EQ(found->stamp_ns, *std::prev(after)) << stamp << " in " << stamps.size() << " stamps";
    ASSERT_EQ(static_cast<std::ptrdiff_t>(found->parent_from_child.translation.x), after - stamps.begin() - 1);
  }
}

TEST(EdgeCache, FindsTheNewestAtOrBeforeForEvenAndExtremeSpacing) {
  std::vector<std::vector<std::int64_t>> cases{
      {}, {0}, {kMin}, {kMax}, {kMin, kMax}, {kMin, 0, kMax}, {kMax - 1, kMax}};
  std::vector<std::int64_t> exponential{kMin};
  for (int bit = 0; bit < 63; ++bit) {
    exponential.push_back(std::int64_t{1} << bit);
  }
  cases.push_back(exponential);
  std::vector<std::int64_t> even(1000);
  for (std::size_t i = 0; i < even.size(); ++i) {
    even[i] = static_cast<std::int64_t>(i) * 10'000'000;
  }
  cases.push_back(even);
  std::vector<std::int64_t> burst = even;  // a dense burst, then a gap of decades
  burst.push_back(kMax);
  cases.push_back(burst);
  std::vector<std::int64_t> bursts;  // dense runs of a prime length, seconds apart: no block is evenly filled
  for (std::int64_t i = 0; i < 5000; ++i) {
    bursts.push_back(i / 37 * 1'000'000'000 + i % 37);
  }
  cases.push_back(bursts);
  std::vector<std::int64_t> sessions;  // enough blocks for a directory, and a pause of a day
  for (std::int64_t i = 0; i < 12'000; ++i) {
    sessions.push_back(i * 10 + (i < 7001 ? 0 : 86'400'000));
  }
  cases.push_back(sessions);
  for (const auto& stamps : cases) {
    const EdgeCache cache = cacheOf(stamps);
    for (const std::int64_t stamp : stamps) {
      expectMatchesUpperBound(cache, stamps, stamp);
      expectMatchesUpperBound(cache, stamps, stamp == kMin ? kMin : stamp - 1);
      expectMatchesUpperBound(cache, stamps, stamp == kMax ? kMax : stamp + 1);
    }
    for (const std::int64_t stamp : {kMin, std::int64_t{-1}, std::int64_t{0}, std::int64_t{1}, kMax}) {
      expectMatchesUpperBound(cache, stamps, stamp);
    }
  }
}

TEST(EdgeCache, FindsTheNewestAtOrBeforeForRandomStamps) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 300; ++round) {
    const std::int64_t range = std::int64_t{1} << std::uniform_int_distribution<int>(1, 62)(random);
    std::uniform_int_distribution<std::int64_t> any(-range, range);
    std::vector<std::int64_t> stamps(std::uniform_int_distribution<std::size_t>(1, 1000)(random));
    std::generate(stamps.begin(), stamps.end(), [&] { return any(random); });
    std::sort(stamps.begin(), stamps.end());
    stamps.erase(std::unique(stamps.begin(), stamps.end()), stamps.end());
    const EdgeCache cache = cacheOf(stamps);
    for (int query = 0; query < 50; ++query) {
      expectMatchesUpperBound(cache, stamps, any(random));
      expectMatchesUpperBound(cache, stamps, stamps[random() % stamps.size()]);
    }
  }
}

TEST(EdgeCache, HoldsLastSampleForwardWithoutLimit) {
  EdgeCache cache;
  cache.insert(TimePoint{100}, translate(1, 0, 0));
  cache.insert(TimePoint{200}, translate(2, 0, 0));
  EXPECT_EQ(cache.find(TimePoint{99}), nullptr);
  EXPECT_DOUBLE_EQ(cache.find(TimePoint{100})->parent_from_child.translation.x, 1.0);
  EXPECT_DOUBLE_EQ(cache.find(TimePoint{199})->parent_from_child.translation.x, 1.0);
  EXPECT_DOUBLE_EQ(cache.find(TimePoint{200})->parent_from_child.translation.x, 2.0);
  EXPECT_DOUBLE_EQ(cache.find(TimePoint{kMax})->parent_from_child.translation.x, 2.0);
}

TEST(EdgeCache, SameStampReplaces) {
  EdgeCache cache;
  cache.insert(TimePoint{kMin}, translate(1, 0, 0));
  cache.insert(TimePoint{kMax}, translate(2, 0, 0));
  cache.insert(TimePoint{kMin}, translate(3, 0, 0));
  cache.insert(TimePoint{kMax}, translate(4, 0, 0));
  EXPECT_EQ(cache.size(), 2u);
  EXPECT_DOUBLE_EQ(cache.find(TimePoint{kMin})->parent_from_child.translation.x, 3.0);
  EXPECT_DOUBLE_EQ(cache.find(TimePoint{kMax})->parent_from_child.translation.x, 4.0);
}

TEST(EdgeCache, AnyOrderOfArrivalEqualsAMap) {
  std::mt19937_64 random(11);
  for (int round = 0; round < 20; ++round) {
    EdgeCache cache;
    std::map<std::int64_t, double> model;
    std::uniform_int_distribution<std::int64_t> any(-2000, 2000);
    for (int i = 0; i < 2000; ++i) {
      const std::int64_t stamp = round % 2 == 0 ? any(random) : i + any(random) / 100;
      cache.insert(TimePoint{stamp}, translate(i, 0, 0));
      model[stamp] = i;
      if (i % 500 == 499) {
        const std::int64_t cutoff = any(random) / 4;
        if (model.rbegin()->first >= cutoff) {
          cache.dropBefore(TimePoint{cutoff});
          model.erase(model.begin(), model.lower_bound(cutoff));
        }
      }
    }
    ASSERT_EQ(cache.size(), model.size());
    ASSERT_EQ(cache.first().ns, model.begin()->first);
    ASSERT_EQ(cache.last().ns, model.rbegin()->first);
    for (std::int64_t stamp = -2100; stamp <= 2100; ++stamp) {
      const auto after = model.upper_bound(stamp);
      const EdgeCache::Sample* found = cache.find(TimePoint{stamp});
      ASSERT_EQ(found == nullptr, after == model.begin());
      if (found != nullptr) {
        ASSERT_EQ(static_cast<int>(found->parent_from_child.translation.x), static_cast<int>(std::prev(after)->second));
      }
    }
  }
}

TEST(EdgeCache, FindsEverySampleOfALongEdgeThatCameShuffled) {
  constexpr std::size_t kCount = 20'000;
  std::vector<std::int64_t> stamps(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    stamps[i] = static_cast<std::int64_t>(i * i / 16 + i);  // an ever slower rate
  }
  std::vector<std::int64_t> shuffled = stamps;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937_64(5));
  EdgeCache cache;
  std::size_t inserted = 0;
  for (const std::int64_t stamp : shuffled) {
    cache.insert(TimePoint{stamp}, {});
    if (++inserted % 4000 == 0) {
      std::vector<std::int64_t> so_far(shuffled.begin(), shuffled.begin() + static_cast<std::ptrdiff_t>(inserted));
      std::sort(so_far.begin(), so_far.end());
      for (std::size_t i = 0; i < inserted; ++i) {
        ASSERT_EQ(cache.find(TimePoint{so_far[i]})->stamp_ns, so_far[i]);
        ASSERT_EQ(cache.find(TimePoint{i + 1 < inserted ? so_far[i + 1] - 1 : kMax})->stamp_ns, so_far[i]);
      }
    }
  }
  cache.dropBefore(TimePoint{stamps[kCount / 2]});
  EXPECT_EQ(cache.find(TimePoint{stamps[kCount / 2] - 1}), nullptr);
  for (std::size_t i = kCount / 2; i < kCount; ++i) {
    ASSERT_EQ(cache.find(TimePoint{stamps[i]})->stamp_ns, stamps[i]);
  }
}

TEST(EdgeCache, HoldsASampleIn72BytesOrLessInAnyOrderOfArrival) {
  constexpr std::size_t kCount = 100'000;
  std::vector<std::int64_t> stamps(kCount);
  std::iota(stamps.begin(), stamps.end(), 0);
  const auto bytesPerSample = [&] {
    EdgeCache cache;
    for (const std::int64_t stamp : stamps) {
      cache.insert(TimePoint{stamp}, {});
    }
    return static_cast<double>(cache.bytes()) / static_cast<double>(kCount);
  };
  EXPECT_LE(bytesPerSample(), 72.0);
  std::shuffle(stamps.begin(), stamps.end(), std::mt19937_64(3));
  EXPECT_LE(bytesPerSample(), 72.0);
}

TEST(EdgeCache, PackedIsAsIfItHadComeInOrder) {
  for (const std::size_t count : {0U, 1U, 2U, 64U, 65U, 129U, 20'000U}) {
    std::vector<std::int64_t> stamps(count);
    std::iota(stamps.begin(), stamps.end(), std::int64_t{1'700'000'000'000'000'000});
    EdgeCache in_order;
    for (const std::int64_t stamp : stamps) {
      in_order.insert(TimePoint{stamp}, translate(static_cast<double>(stamp % 1000), 0, 0));
    }
    EXPECT_FALSE(in_order.isLoose()) << count;
    std::shuffle(stamps.begin(), stamps.end(), std::mt19937_64(11));
    EdgeCache shuffled;
    for (const std::int64_t stamp : stamps) {
      shuffled.insert(TimePoint{stamp}, translate(static_cast<double>(stamp % 1000), 0, 0));
    }
    EXPECT_TRUE(count < 1000 || shuffled.isLoose());
    EdgeCache packed = shuffled.packed();
    EXPECT_FALSE(packed.isLoose()) << count;
    EXPECT_LE(packed.bytes(), in_order.bytes()) << count;
    ASSERT_EQ(packed.size(), count);
    for (const std::int64_t stamp : stamps) {
      const EdgeCache::Sample* const found = packed.find(TimePoint{stamp});
      ASSERT_NE(found, nullptr);
      ASSERT_EQ(found->stamp_ns, stamp);
      ASSERT_EQ(found->parent_from_child.translation.x, static_cast<double>(stamp % 1000));
    }
    packed.insert(TimePoint{kMax}, translate(1, 0, 0));
    packed.insert(TimePoint{kMin}, translate(2, 0, 0));
    EXPECT_EQ(packed.find(TimePoint{kMax})->parent_from_child.translation.x, 1);
    EXPECT_EQ(packed.find(TimePoint{kMin})->parent_from_child.translation.x, 2);
    EXPECT_EQ(packed.size(), count + 2);
  }
}

}  // namespace
}  // namespace stillframe::tf
