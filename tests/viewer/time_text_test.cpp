#include "viewer/time/time_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace stillframe::viewer {
namespace {

using tf::TimePoint;
using namespace tf::literals;

constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
const TimeRange kRange{TimePoint{1'700'000'000'000'000'001}, TimePoint{1'700'000'020'000'000'003}};

TEST(TimeText, ReadsNanosecondsSecondsFromTheStartAndWords) {
  EXPECT_EQ(parseTime(QStringLiteral("1700000012345678901"), kRange), TimePoint{1'700'000'012'345'678'901});
  EXPECT_EQ(parseTime(QStringLiteral("-5"), kRange), TimePoint{-5});
  EXPECT_EQ(parseTime(QStringLiteral(" +12.5 "), kRange), TimePoint{1'700'000'012'500'000'001});
  EXPECT_EQ(parseTime(QStringLiteral("+0.000000001s"), kRange), TimePoint{1'700'000'000'000'000'002});
  EXPECT_EQ(parseTime(QStringLiteral("start"), kRange), kRange.first);
  EXPECT_EQ(parseTime(QStringLiteral("end"), kRange), kRange.last);
}

TEST(TimeText, RefusesWhatIsNoTime) {
  for (const char* text : {"", "+", "12.5", "+1.0000000001", "+-1", "x", "+1e3", "99999999999999999999", "+1 2",
                           "+9999999999999999999", "+."}) {
    EXPECT_FALSE(parseTime(QString::fromUtf8(text), kRange)) << text;
  }
}

TEST(TimeText, WritesWhatItReadsBackExactly) {
  for (const std::int64_t ns :
       {kRange.first.ns, kRange.first.ns + 1, kRange.first.ns + 12'345'678'901, kRange.last.ns}) {
    EXPECT_EQ(parseTime(secondsText(TimePoint{ns}, kRange), kRange), TimePoint{ns});
  }
  EXPECT_EQ(secondsText(TimePoint{kRange.first.ns + 1'500'000'000}, kRange, 1), QStringLiteral("+1.5"));
  EXPECT_EQ(secondsText(TimePoint{kRange.first.ns - 1'500'000'000}, kRange, 1), QStringLiteral("-1.5"));
}

TEST(TimeText, SliderReachesBothEndsOfAnyRangeExactly) {
  for (const TimeRange& range :
       {kRange, TimeRange{TimePoint{kMin}, TimePoint{kMax}}, TimeRange{TimePoint{5}, TimePoint{6}},
        TimeRange{TimePoint{7}, TimePoint{7}}, TimeRange{TimePoint{kMax - 1}, TimePoint{kMax}}}) {
    EXPECT_EQ(timeAtStep(0, 1'000'000, range), range.first);
    EXPECT_EQ(timeAtStep(1'000'000, 1'000'000, range), range.last);
    EXPECT_EQ(stepAtTime(range.first, 1'000'000, range), 0);
  }
}

TEST(TimeText, SliderStepsComeBackFromTheirTimes) {
  for (const TimeRange& range : {kRange, TimeRange{TimePoint{kMin}, TimePoint{kMax}}}) {
    for (int step = 0; step <= 1'000'000; step += 12'345) {
      EXPECT_EQ(stepAtTime(timeAtStep(step, 1'000'000, range), 1'000'000, range), step);
    }
  }
}

TEST(TimeText, ShiftingStaysWithinTheRange) {
  EXPECT_EQ(shifted(kRange.first, 5, kRange), TimePoint{kRange.first.ns + 5});
  EXPECT_EQ(shifted(kRange.last, -3, kRange), TimePoint{kRange.last.ns - 3});
  EXPECT_EQ(shifted(kRange.first, kMax, kRange), kRange.last);
  EXPECT_EQ(shifted(kRange.last, kMin, kRange), kRange.first);
  const TimeRange all{TimePoint{kMin}, TimePoint{kMax}};
  EXPECT_EQ(shifted(TimePoint{kMax - 1}, 10, all), TimePoint{kMax});
  EXPECT_EQ(shifted(TimePoint{kMin + 1}, -10, all), TimePoint{kMin});
}

}  // namespace
}  // namespace stillframe::viewer
