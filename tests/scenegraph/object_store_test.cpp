#include "scenegraph/store/object_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <thread>

#include "tests/support/builders.h"

namespace stillframe::scenegraph {
namespace {

using test::kMax;
using test::kMin;
using test::Random;
using namespace tf::literals;

Entry entryAt(std::int64_t ns, std::uint64_t locator = 0) {
  Entry entry;
  entry.log_time = tf::TimePoint{ns};
  entry.locator = locator;
  return entry;
}

TopicInfo info(const std::string& name, ObjectType type = ObjectType::PointCloud) {
  TopicInfo topic;
  topic.name = name;
  topic.type = type;
  return topic;
}

class StoreWithTopic : public testing::Test {
 protected:
  void add(const std::vector<std::int64_t>& times) {
    std::vector<Entry> entries;
    for (const std::int64_t ns : times) {
      entries.push_back(entryAt(ns, added_++));
    }
    store.append(topic, entries);
  }
  std::vector<std::int64_t> times() const {
    std::vector<std::int64_t> all;
    for (const Entry& entry : store.range(topic, std::nullopt, tf::TimePoint{kMax})) {
      all.push_back(entry.log_time.ns);
    }
    return all;
  }
  ObjectStore store;
  TopicId topic = store.addTopic(info("/points"), std::make_shared<test::FakeSource>());

 private:
  std::uint64_t added_ = 0;
};

TEST_F(StoreWithTopic, AnswersNewestAtOrBefore) {
  add({10, 20, 30});
  EXPECT_FALSE(store.newestAtOrBefore(topic, tf::TimePoint{9}));
  EXPECT_EQ(store.newestAtOrBefore(topic, tf::TimePoint{10})->log_time.ns, 10);
  EXPECT_EQ(store.newestAtOrBefore(topic, tf::TimePoint{19})->log_time.ns, 10);
  EXPECT_EQ(store.newestAtOrBefore(topic, tf::TimePoint{20})->log_time.ns, 20);
  EXPECT_EQ(store.newestAtOrBefore(topic, tf::TimePoint{kMax})->log_time.ns, 30);
  EXPECT_FALSE(store.newestAtOrBefore(topic, tf::TimePoint{kMin}));
  EXPECT_EQ(store.countAtOrBefore(topic, tf::TimePoint{9}), 0U);
  EXPECT_EQ(store.countAtOrBefore(topic, tf::TimePoint{20}), 2U);
  EXPECT_EQ(store.countAtOrBefore(topic, tf::TimePoint{kMax}), 3U);
  EXPECT_EQ(store.countAtOrBefore(topic + 1, tf::TimePoint{kMax}), 0U);
}

TEST_F(StoreWithTopic, HoldsTheEndsOfInt64) {
  add({kMax, kMin, 0});
  EXPECT_EQ(times(), (std::vector<std::int64_t>{kMin, 0, kMax}));
  EXPECT_EQ(store.newestAtOrBefore(topic, tf::TimePoint{kMin})->log_time.ns, kMin);
  EXPECT_EQ(store.span(topic)->second.ns, kMax);
}

TEST_F(StoreWithTopic, RangeIsOpenAtTheStartAndClosedAtTheEnd) {
  add({10, 20, 30});
  const auto range = store.range(topic, tf::TimePoint{10}, tf::TimePoint{30});
  ASSERT_EQ(range.size(), 2U);
  EXPECT_EQ(range[0].log_time.ns, 20);
  EXPECT_EQ(range[1].log_time.ns, 30);
  EXPECT_TRUE(store.range(topic, tf::TimePoint{30}, tf::TimePoint{10}).empty());
}

TEST_F(StoreWithTopic, TiesGoByArrival) {
  add({10, 10});
  add({10});
  EXPECT_EQ(store.newestAtOrBefore(topic, tf::TimePoint{10})->locator, 2U);
  const auto range = store.range(topic, std::nullopt, tf::TimePoint{10});
  ASSERT_EQ(range.size(), 3U);
  EXPECT_EQ(range[0].locator, 0U);
  EXPECT_EQ(range[1].locator, 1U);
}

TEST_F(StoreWithTopic, MergesWhatComesOutOfOrderLikeAStableSort) {
  Random random(7);
  std::vector<std::pair<std::int64_t, std::uint64_t>> expected;  // time, arrival
  for (int batch = 0; batch < 50; ++batch) {
    std::vector<std::int64_t> batch_times;
    for (std::size_t i = random.index(20); i > 0; --i) {
      batch_times.push_back(static_cast<std::int64_t>(random.index(40)));
      expected.emplace_back(batch_times.back(), expected.size());
    }
    add(batch_times);
  }
  std::ranges::sort(expected);
  const auto range = store.range(topic, std::nullopt, tf::TimePoint{kMax});
  ASSERT_EQ(range.size(), expected.size());
  for (std::size_t i = 0; i < range.size(); ++i) {
    EXPECT_EQ(range[i].log_time.ns, expected[i].first);
    EXPECT_EQ(range[i].locator, expected[i].second);
    EXPECT_EQ(store.at(topic, i)->locator, expected[i].second);
  }
  EXPECT_FALSE(store.at(topic, range.size()));
}

TEST_F(StoreWithTopic, ArrivedSinceSeesWhatIsNewWhateverItsTime) {
  add({10, 30});
  const std::uint64_t cursor = store.at(topic, 1)->sequence + 1;
  EXPECT_TRUE(store.arrivedSince(topic, cursor).empty());
  add({40});
  EXPECT_EQ(store.arrivedSince(topic, cursor).size(), 1U);
  add({20, 5});
  const auto arrived = store.arrivedSince(topic, cursor);
  ASSERT_EQ(arrived.size(), 3U);
  EXPECT_EQ(arrived[0].log_time.ns, 5);
  EXPECT_EQ(arrived[1].log_time.ns, 20);
  EXPECT_EQ(arrived[2].log_time.ns, 40);
  EXPECT_EQ(store.arrivedSince(topic, 0).size(), 5U);
}

TEST_F(StoreWithTopic, MergesShuffledBatchesInLessThanQuadraticTime) {
  // A quadratic merge of one entry at a time would move 1e6 * 5e5 entries: minutes.
  std::vector<Entry> entries;
  for (std::int64_t i = 0; i < 1'000'000; ++i) {
    entries.push_back(entryAt((i * 7'919) % 1'000'003));
  }
  const auto start = std::chrono::steady_clock::now();
  store.append(topic, entries);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  EXPECT_EQ(store.entryCount(topic), entries.size());
}

TEST(ObjectStore, ReusesATopicOfTheSameNameAndType) {
  ObjectStore store;
  const TopicId a = store.addTopic(info("/a"), nullptr);
  EXPECT_EQ(store.addTopic(info("/a"), nullptr), a);
  const TopicId scan = store.addTopic(info("/a", ObjectType::LaserScan), nullptr);
  EXPECT_NE(scan, a);
  EXPECT_EQ(store.findTopic("/a"), a);
  EXPECT_EQ(store.findTopic("/a", ObjectType::LaserScan), scan);
  EXPECT_FALSE(store.findTopic("/b"));
}

TEST(ObjectStore, AnswersForUnknownTopicsWithNothing) {
  ObjectStore store;
  store.append(3, std::vector<Entry>{entryAt(1)});
  EXPECT_EQ(store.entryCount(3), 0U);
  EXPECT_FALSE(store.newestAtOrBefore(3, {}));
  EXPECT_TRUE(store.range(3, std::nullopt, {}).empty());
  EXPECT_FALSE(store.at(3, 0));
  EXPECT_FALSE(store.span(3));
  EXPECT_EQ(store.topic(3).name, "");
  EXPECT_EQ(store.decode(3, {}).error().code, "NoDecoder");
}

TEST(ObjectStore, TurnsAnExceptionOfADecoderIntoAnError) {
  ObjectStore store;
  const TopicId topic = store.addTopic(info("/a"), std::make_shared<test::FakeSource>());
  EXPECT_EQ(store.decode(topic, entryAt(0, 99)).error().code, "DecodeFailed");  // FakeSource throws out_of_range
}

TEST(ObjectStore, TellsListenersOutsideItsLockUntilTheTokenGoes) {
  ObjectStore store;
  std::vector<std::size_t> counts;
  auto token = store.listen([&](TopicId topic) { counts.push_back(store.entryCount(topic)); });
  const TopicId topic = store.addTopic(info("/a"), nullptr);
  store.append(topic, std::vector<Entry>{entryAt(1), entryAt(2)});
  store.append(topic, {});
  EXPECT_EQ(counts, (std::vector<std::size_t>{0, 2}));
  token.reset();
  store.append(topic, std::vector<Entry>{entryAt(3)});
  EXPECT_EQ(counts.size(), 2U);
}

TEST(ObjectStore, RevisionChangesWithEveryGrowth) {
  ObjectStore store;
  const auto empty = store.revision();
  const TopicId topic = store.addTopic(info("/a"), nullptr);
  const auto with_topic = store.revision();
  EXPECT_NE(with_topic, empty);
  EXPECT_EQ(store.addTopic(info("/a"), nullptr), topic);
  EXPECT_EQ(store.revision(), with_topic);
  store.append(topic, std::vector<Entry>{entryAt(1)});
  EXPECT_NE(store.revision(), with_topic);
}

TEST(ObjectStore, OneWriterAndFourReadersAgree) {
  ObjectStore store;
  const TopicId topic = store.addTopic(info("/a"), std::make_shared<test::FakeSource>());
  std::atomic<bool> has_ended = false;
  std::atomic<std::size_t> told = 0;
  auto token = store.listen([&](TopicId) { ++told; });
  std::vector<std::thread> readers;
  std::atomic<std::size_t> faults = 0;
  for (int i = 0; i < 4; ++i) {
    readers.emplace_back([&, seed = static_cast<std::uint64_t>(i)] {
      Random random(seed);
      while (!has_ended) {
        const tf::TimePoint t{static_cast<std::int64_t>(random.index(2'000))};
        if (const auto newest = store.newestAtOrBefore(topic, t); newest && newest->log_time > t) {
          ++faults;
        }
        const auto range = store.range(topic, tf::TimePoint{t.ns - 50}, t);
        if (!std::ranges::is_sorted(range, {}, &Entry::log_time)) {
          ++faults;
        }
        const auto listener = store.listen([](TopicId) {});
        (void)store.span(topic);
        (void)store.decode(topic, entryAt(0, 99));
        (void)store.arrivedSince(topic, random.index(2'000));
      }
    });
  }
  Random random(11);
  for (int i = 0; i < 400; ++i) {
    store.append(topic, std::vector<Entry>{entryAt(static_cast<std::int64_t>(random.index(2'000))),
                                           entryAt(static_cast<std::int64_t>(i))});
  }
  store.addTopic(info("/b"), nullptr);
  has_ended = true;
  for (std::thread& reader : readers) {
    reader.join();
  }
  EXPECT_EQ(faults, 0U);
  EXPECT_EQ(told, 401U);
  EXPECT_EQ(store.entryCount(topic), 800U);
}

}  // namespace
}  // namespace stillframe::scenegraph
