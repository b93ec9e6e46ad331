#include "scenegraph/store/dataset.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <thread>

#include "scenegraph/store/tf_clock.h"
#include "tests/support/builders.h"

namespace stillframe::scenegraph {
namespace {

using test::DatasetBuilder;
using test::kMax;
using test::kMin;
using test::Random;
using test::translate;
using namespace tf::literals;

constexpr std::int64_t kEpoch = 1'700'000'000'000'000'000;

const Problem* findProblem(const std::vector<Problem>& problems, const std::string& code) {
  const auto found = std::ranges::find(problems, code, &Problem::code);
  return found == problems.end() ? nullptr : &*found;
}

double xOf(const Dataset& dataset, const std::string& child, std::int64_t t) {
  const auto found = dataset.transforms()->tryLookupTransform("map", child, {t});
  return found ? found->translation.x : -1.0;
}

/// `count` samples of map -> base at 10 Hz, x counting up; header stamps ride behind the log by `header_shift_ns`.
DatasetBuilder drive(int count, std::int64_t header_shift_ns) {
  DatasetBuilder builder;
  builder.topic("/tf", ObjectType::FrameTransforms);
  for (int i = 0; i < count; ++i) {
    const std::int64_t log = kEpoch + i * 100_ms;
    builder.transform(log, "map", "base", translate(i, 0, 0), log - header_shift_ns);
  }
  return builder;
}

TEST(CompareClocks, HoldsAtTheEndsOfInt64) {
  const ClockSample samples[] = {{0, {kMin}, {kMax}}, {0, {kMin}, {kMax}}};
  EXPECT_TRUE(compareClocks(samples).is_mismatch);
  const ClockSample same[] = {{0, {kMin}, {kMin}}, {0, {kMax}, {kMax}}};
  EXPECT_FALSE(compareClocks(same).is_mismatch);
  EXPECT_FALSE(compareClocks({}).is_mismatch);
}

TEST(CompareClocks, AGapOfMoreThanASecondOrAMedianOfMoreThanTenIsAMismatch) {
  const auto shifted = [](std::int64_t shift, int count) {
    std::vector<ClockSample> samples;
    for (std::int64_t i = 0; i < count; ++i) {
      samples.push_back({0, {i * 1_s}, {i * 1_s + shift}});
    }
    return compareClocks(samples).is_mismatch;
  };
  EXPECT_FALSE(shifted(1_s, 1));
  EXPECT_TRUE(shifted(1_s + 1, 1));
  EXPECT_FALSE(shifted(-1_s, 1));
  EXPECT_TRUE(shifted(-1_s - 1, 1));
  EXPECT_FALSE(shifted(10_s, 60)) << "the intervals overlap";
  EXPECT_TRUE(shifted(10_s + 1_ms, 60));
}

TEST(TimeText, IsExactOverAllOfInt64) {
  EXPECT_EQ(timeText({0}), "0.000000000 s");
  EXPECT_EQ(timeText({-1}), "-0.000000001 s");
  EXPECT_EQ(timeText({kMax}), "9223372036.854775807 s");
  EXPECT_EQ(timeText({kMin}), "-9223372036.854775808 s");
}

TEST(Dataset, UsesHeaderStampsOfTheSameClock) {
  const auto dataset = drive(20, 50_ms).build();
  EXPECT_EQ(dataset->tfClockInUse(), TfClock::Header);
  EXPECT_TRUE(dataset->problems().empty());
  EXPECT_DOUBLE_EQ(xOf(*dataset, "base", kEpoch - 50_ms), 0.0);
}

TEST(Dataset, FallsBackToLogTimesOnAnotherEpochAndSaysSoWithBothRanges) {
  const auto dataset = drive(20, kEpoch).build();
  EXPECT_EQ(dataset->tfClock(), TfClock::Auto);
  EXPECT_EQ(dataset->tfClockInUse(), TfClock::Log);
  EXPECT_DOUBLE_EQ(xOf(*dataset, "base", kEpoch + 500_ms), 5.0) << "the robot moves";
  const auto problems = dataset->problems();
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].code, "ClockMismatch");
  EXPECT_TRUE(problems[0].message.contains("[0.000000000 s, 1.900000000 s]")) << problems[0].message;
  EXPECT_TRUE(problems[0].message.contains("[1700000000.000000000 s, 1700000001.900000000 s]")) << problems[0].message;
}

TEST(Dataset, StaticTransformsDoNotDecideTheClockButFollowIt) {
  DatasetBuilder builder = drive(20, kEpoch);
  builder.topic("/tf_static", ObjectType::FrameTransforms);
  builder.transform(kEpoch, "base", "lidar", translate(0, 0, 1), 7);
  const auto dataset = builder.build();
  EXPECT_TRUE(dataset->transforms()->tryLookupTransform("map", "lidar", {kEpoch}));
  EXPECT_FALSE(dataset->transforms()->tryLookupTransform("map", "lidar", {kEpoch - 1}));
  const auto lidar = dataset->transforms()->findFrame("lidar");
  ASSERT_TRUE(lidar);
  EXPECT_TRUE(dataset->transforms()->edge(*lidar)->is_static);

  DatasetBuilder other = drive(20, 0);
  other.topic("/tf_static", ObjectType::FrameTransforms);
  for (std::int64_t i = 0; i < 100; ++i) {
    other.transform(kEpoch, "base", "lidar", {}, i);
  }
  EXPECT_EQ(other.build()->tfClockInUse(), TfClock::Header);
}

TEST(Dataset, NamesEdgesThatRideAnotherClockThanTheOthers) {
  DatasetBuilder builder = drive(50, 0);
  for (int i = 0; i < 10; ++i) {
    builder.transform(kEpoch + i * 100_ms, "map", "stray", translate(1, 0, 0), i * 100_ms);
  }
  const auto dataset = builder.build();
  EXPECT_EQ(dataset->tfClockInUse(), TfClock::Header);
  const auto problems = dataset->problems();
  const Problem* const mixed = findProblem(problems, "ClockMixed");
  ASSERT_NE(mixed, nullptr);
  EXPECT_TRUE(mixed->message.contains("'map' -> 'stray'")) << mixed->message;
  EXPECT_FALSE(mixed->message.contains("'base'")) << mixed->message;
}

TEST(Dataset, SwitchingTheClockRebuildsTheTransformsAndTheProblems) {
  const auto dataset = drive(20, kEpoch).build();
  for (int round = 0; round < 2; ++round) {
    dataset->setTfClock(TfClock::Header);
    EXPECT_EQ(dataset->tfClockInUse(), TfClock::Header);
    EXPECT_DOUBLE_EQ(xOf(*dataset, "base", kEpoch + 500_ms), 19.0) << "the last pose holds for ever";
    EXPECT_DOUBLE_EQ(xOf(*dataset, "base", 500_ms), 5.0);
    EXPECT_TRUE(dataset->problems().empty());
    dataset->setTfClock(TfClock::Log);
    EXPECT_DOUBLE_EQ(xOf(*dataset, "base", kEpoch + 500_ms), 5.0);
    EXPECT_TRUE(dataset->problems().empty());
    dataset->setTfClock(TfClock::Auto);
    EXPECT_EQ(dataset->tfClockInUse(), TfClock::Log);
    EXPECT_EQ(dataset->problems().size(), 1U);
    EXPECT_EQ(dataset->transforms()->edge(*dataset->transforms()->findFrame("base"))->samples, 20U);
  }
}

TEST(Dataset, AClockSetBeforeLoadingIsUsedFromTheStart) {
  DatasetBuilder builder = drive(20, kEpoch);
  builder.raw()->setTfClock(TfClock::Header);
  EXPECT_DOUBLE_EQ(xOf(*builder.build(), "base", 500_ms), 5.0);
  EXPECT_EQ(builder.source().decodeCount(), 20U);
}

TEST(Dataset, TakesNothingTwiceAndLateEntriesToo) {
  DatasetBuilder builder = drive(20, 0);
  (void)builder.build();
  EXPECT_EQ(builder.source().decodeCount(), 20U);
  (void)builder.build();
  EXPECT_EQ(builder.source().decodeCount(), 20U);
  builder.transform(kEpoch - 5_s, "map", "base", translate(-7, 0, 0));  // older than all before
  const auto dataset = builder.build();
  EXPECT_EQ(builder.source().decodeCount(), 21U);
  EXPECT_DOUBLE_EQ(xOf(*dataset, "base", kEpoch - 4_s), -7.0);
}

TEST(Dataset, ALiveClockIsDecidedAgainWhileItRestsOnFewSamples) {
  DatasetBuilder builder = drive(2, 1'200_ms);  // the first two samples alone look like another epoch
  EXPECT_EQ(builder.build()->tfClockInUse(), TfClock::Log);
  for (int i = 2; i < 40; ++i) {
    const std::int64_t log = kEpoch + i * 100_ms;
    builder.transform(log, "map", "base", translate(i, 0, 0), log - 1'200_ms);
  }
  const auto dataset = builder.build();
  EXPECT_EQ(dataset->tfClockInUse(), TfClock::Header);
  EXPECT_TRUE(dataset->problems().empty());
  EXPECT_DOUBLE_EQ(xOf(*dataset, "base", kEpoch - 1'200_ms), 0.0) << "the early samples moved as well";
  for (int i = 40; i < 400; ++i) {
    builder.transform(kEpoch + i * 100_ms, "map", "base", translate(i, 0, 0), 5);
  }
  EXPECT_EQ(builder.build()->tfClockInUse(), TfClock::Header) << "a decision from enough samples stays";
}

TEST(Dataset, StopsEarlyAndGoesOnFromThere) {
  for (const TfClock clock : {TfClock::Auto, TfClock::Header}) {
    DatasetBuilder builder = drive(2'000, 0);
    const auto& dataset = builder.raw();
    dataset->setTfClock(clock);
    std::uint64_t all = 0;
    dataset->takeTransforms([&](std::uint64_t done, std::uint64_t of) {
      all = of;
      return done < 500;
    });
    EXPECT_EQ(all, 2'000U);
    EXPECT_LT(builder.source().decodeCount(), 1'000U);
    dataset->takeTransforms();
    EXPECT_EQ(builder.source().decodeCount(), 2'000U);
    EXPECT_EQ(dataset->transforms()->edge(*dataset->transforms()->findFrame("base"))->samples, 2'000U);
  }
}

TEST(Dataset, WhoWatchesTheProgressFindsWhatHasBeenDecodedSoFar) {
  for (const TfClock clock : {TfClock::Auto, TfClock::Log}) {
    DatasetBuilder builder = drive(2'000, 0);
    const auto& dataset = builder.raw();
    dataset->setTfClock(clock);
    int looks = 0;
    dataset->takeTransforms([&](std::uint64_t done, std::uint64_t all) {
      const auto newest = static_cast<double>(done - 1);
      EXPECT_DOUBLE_EQ(xOf(*dataset, "base", kEpoch + 1'000'000_ms), newest);
      looks += done < all ? 1 : 0;
      return true;
    });
    EXPECT_GT(looks, 3);
    EXPECT_EQ(dataset->transforms()->edge(*dataset->transforms()->findFrame("base"))->samples, 2'000U);
  }
}

TEST(Dataset, TheClockOfTheFirstTransformsGivesWayToThatOfAll) {
  DatasetBuilder builder = drive(300, 0);
  for (int i = 300; i < 2'000; ++i) {
    builder.transform(kEpoch + i * 100_ms, "map", "base", translate(i, 0, 0), i * 100_ms);
  }
  const auto& dataset = builder.raw();
  std::vector<double> seen;
  dataset->takeTransforms([&](std::uint64_t, std::uint64_t) {
    seen.push_back(xOf(*dataset, "base", kEpoch + 10_s));
    return true;
  });
  EXPECT_DOUBLE_EQ(seen.front(), 100.0) << "by header stamps, as the first transforms have it";
  EXPECT_EQ(dataset->tfClockInUse(), TfClock::Log);
  EXPECT_DOUBLE_EQ(xOf(*dataset, "base", kEpoch + 10_s), 100.0);
  EXPECT_DOUBLE_EQ(xOf(*dataset, "base", kEpoch + 100_s), 1'000.0);
  EXPECT_FALSE(dataset->transforms()->tryLookupTransform("map", "base", {kEpoch - 1})) << "nothing of the old clock";
  EXPECT_EQ(dataset->transforms()->edge(*dataset->transforms()->findFrame("base"))->samples, 2'000U);
  EXPECT_EQ(builder.source().decodeCount(), 2'000U) << "nothing is decoded twice";
  const auto problems = dataset->problems();
  EXPECT_NE(findProblem(problems, "ClockMismatch"), nullptr);
}

TEST(Dataset, ReportsRefusedEdgesOncePerEdgeWithTheirCount) {
  DatasetBuilder builder = drive(20, 0);
  const auto at = [](int i) { return kEpoch + i * 100_ms + 1_ms; };
  for (int i = 0; i < 3; ++i) {
    builder.transform(at(i), "odom", "base");
    builder.transform(at(i), "loop", "loop");
    builder.transform(at(i), "base", "map");
    builder.transform(at(i), "map", "");
    builder.transform(at(i), "map", "bad", translate(std::numeric_limits<double>::quiet_NaN(), 0, 0));
    builder.transform(at(i), "map", "zero", {.rotation = {0, 0, 0, 0}, .translation = {}});
  }
  const auto dataset = builder.build();
  for (int round = 0; round < 2; ++round) {
    const auto problems = dataset->problems();
    EXPECT_EQ(problems.size(), 6U);
    for (const char* code :
         {"ReparentConflict", "SelfLoop", "Cycle", "EmptyFrameName", "NotFinite", "ZeroQuaternion"}) {
      const Problem* const problem = findProblem(problems, code);
      ASSERT_NE(problem, nullptr) << code;
      EXPECT_EQ(problem->count, 3U) << code;
    }
    EXPECT_TRUE(findProblem(problems, "ReparentConflict")->message.contains("already has the parent 'map'"));
    dataset->setTfClock(round == 0 ? TfClock::Log : TfClock::Auto);
  }
}

TEST(Dataset, CountsTransformMessagesThatCannotBeDecoded) {
  DatasetBuilder builder = drive(20, 0);
  builder.failsAt(kEpoch + 1, "TruncatedMessage").failsAt(kEpoch + 2, "TruncatedMessage");
  builder.at(kEpoch + 3, test::CloudBuilder("lidar").xyz().build());
  const auto dataset = builder.build();
  dataset->setTfClock(TfClock::Log);
  const auto problems = dataset->problems();
  ASSERT_EQ(problems.size(), 2U);
  const Problem* const truncated = findProblem(problems, "TruncatedMessage");
  ASSERT_NE(truncated, nullptr);
  EXPECT_EQ(truncated->count, 2U);
  EXPECT_TRUE(truncated->message.contains("'/tf'") && truncated->message.contains("made to fail"));
  EXPECT_NE(findProblem(problems, "WrongObject"), nullptr);
}

TEST(Dataset, ListsNoMoreProblemsThanItCanHold) {
  const auto dataset = std::make_shared<Dataset>("many");
  for (int i = 0; i < 5'000; ++i) {
    dataset->addProblem({"Odd", std::to_string(i), 2});
    dataset->addProblem({"Odd", "0", 1});
  }
  const auto problems = dataset->problems();
  EXPECT_LE(problems.size(), 1'025U);
  EXPECT_EQ(problems.front().count, 5'002U);
  EXPECT_EQ(problems.back().code, "MoreProblems");
  std::uint64_t sum = 0;
  for (const Problem& problem : problems) {
    sum += problem.count;
  }
  EXPECT_EQ(sum, 15'000U);
}

TEST(Dataset, TimeRangeIsThatOfTheFileOrTheEntriesWhicheverIsWider) {
  DatasetBuilder builder;
  EXPECT_FALSE(builder.raw()->timeRange());
  builder.raw()->setTimeRange({20}, {10});
  EXPECT_EQ(builder.raw()->timeRange(), std::pair(tf::TimePoint{10}, tf::TimePoint{20}));
  builder.topic("/tf", ObjectType::FrameTransforms).transform(5, "a", "b");
  EXPECT_EQ(builder.raw()->timeRange(), std::pair(tf::TimePoint{5}, tf::TimePoint{20}));
}

TEST(Dataset, MayBeReadWhileItGrows) {
  DatasetBuilder builder = drive(20, 0);
  const auto dataset = builder.build();
  std::atomic<bool> has_ended = false;
  std::vector<std::thread> readers;
  for (int i = 0; i < 4; ++i) {
    readers.emplace_back([&] {
      while (!has_ended) {
        (void)dataset->problems();
        (void)dataset->timeRange();
        (void)dataset->tfClockInUse();
        (void)dataset->transforms()->tryLookupTransform("map", "base", {kEpoch + 1_s});
      }
    });
  }
  for (int i = 20; i < 120; ++i) {
    const std::int64_t log = kEpoch + i * 100_ms;
    (void)builder.transform(log, "map", "base", translate(i, 0, 0)).build();
    if (i % 30 == 0) {
      dataset->setTfClock(i % 60 == 0 ? TfClock::Log : TfClock::Auto);
    }
  }
  has_ended = true;
  for (std::thread& reader : readers) {
    reader.join();
  }
  EXPECT_DOUBLE_EQ(xOf(*dataset, "base", kMax), 119.0);
}

}  // namespace
}  // namespace stillframe::scenegraph
