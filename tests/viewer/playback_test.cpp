#include "viewer/time/playback.h"

#include <gtest/gtest.h>

namespace stillframe::viewer {
namespace {

using tf::TimePoint;
using namespace tf::literals;

const TimeRange kRange{TimePoint{100_s}, TimePoint{110_s}};

TEST(Playback, FollowsTheClockAtItsSpeed) {
  PlaybackClock clock;
  clock.start(5_s, TimePoint{102_s}, kRange, {.speed = 2.0});
  EXPECT_EQ(clock.read(5_s).time, TimePoint{102_s});
  EXPECT_EQ(clock.read(6_s + 500_ms).time, TimePoint{105_s});
}

TEST(Playback, LateReadingSkipsAheadInsteadOfFallingBehind) {
  PlaybackClock clock;
  clock.start(0, TimePoint{100_s}, kRange, {});
  EXPECT_EQ(clock.read(16_ms).time, TimePoint{100_s + 16_ms});
  EXPECT_EQ(clock.read(3_s).time, TimePoint{103_s});
}

TEST(Playback, EndsAtTheLastInstantExactly) {
  PlaybackClock clock;
  clock.start(0, TimePoint{109_s}, kRange, {});
  EXPECT_FALSE(clock.read(999_ms).ended);
  const auto reading = clock.read(5_s);
  EXPECT_TRUE(reading.ended);
  EXPECT_EQ(reading.time, kRange.last);
}

TEST(Playback, LoopGoesRoundToTheSameTimes) {
  PlaybackClock clock;
  clock.start(0, TimePoint{109_s}, kRange, {.loops = true});
  EXPECT_EQ(clock.read(3_s).time, TimePoint{102_s});
  EXPECT_EQ(clock.read(23_s).time, TimePoint{102_s});
  EXPECT_FALSE(clock.read(1'000'000_s).ended);
}

TEST(Playback, StartsOverFromTheEnd) {
  PlaybackClock clock;
  clock.start(0, kRange.last, kRange, {});
  EXPECT_EQ(clock.read(1_s).time, TimePoint{101_s});
}

TEST(Playback, EmptyRangeEndsAtOnce) {
  PlaybackClock clock;
  clock.start(0, TimePoint{7}, {TimePoint{7}, TimePoint{7}}, {.loops = true});
  EXPECT_TRUE(clock.read(1_s).ended);
}

}  // namespace
}  // namespace stillframe::viewer
