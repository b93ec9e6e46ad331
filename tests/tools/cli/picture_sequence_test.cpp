#include "tools/cli/picture_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace stillframe::cli {
namespace {

using tf::TimePoint;

constexpr std::pair kSeconds{TimePoint{1'000'000'000}, TimePoint{11'000'000'000}};

std::vector<std::int64_t> instants(std::string_view text, const std::pair<TimePoint, TimePoint>& range = kSeconds) {
  const auto asked = parseTimes(text);
  const auto times = asked ? resolveTimes(*asked, range) : std::unexpected(asked.error());
  std::vector<std::int64_t> ns;
  for (const TimePoint time : times ? *times : std::vector<TimePoint>{}) {
    ns.push_back(time.ns);
  }
  return ns;
}

TEST(PictureSequence, GoesFromTheFirstTimeAsFarAsTheLast) {
  EXPECT_EQ(instants("+0:+1:0.5"), (std::vector<std::int64_t>{1'000'000'000, 1'500'000'000, 2'000'000'000}));
  EXPECT_EQ(instants("start:+1:0.4"), (std::vector<std::int64_t>{1'000'000'000, 1'400'000'000, 1'800'000'000}));
  EXPECT_EQ(instants("end:end:7"), (std::vector<std::int64_t>{11'000'000'000}));
  EXPECT_EQ(instants("1000000007:1000000009:0.000000001"),
            (std::vector<std::int64_t>{1'000'000'007, 1'000'000'008, 1'000'000'009}));
  // A tenth of a second is one to the last.
  EXPECT_EQ(instants("start:end:0.1").size(), 101U);
  EXPECT_EQ(instants("start:end:0.1").back(), 11'000'000'000);
}

TEST(PictureSequence, SpansTheWholeRangeOfTimes) {
  constexpr std::int64_t kLowest = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kHighest = std::numeric_limits<std::int64_t>::max();
  const std::pair all{TimePoint{kLowest}, TimePoint{kHighest}};
  const auto times = instants("start:end:9223372036.854775807", all);
  ASSERT_EQ(times.size(), 3U);
  EXPECT_EQ(times.back(), kHighest - 1);
}

TEST(PictureSequence, RefusesWhatIsNoSequence) {
  for (const char* text : {"", "+0", "+0:+1", "+0:+1:", "+0:+1:0", "+0:+1:-1", "+0:+1:0.0000000001", "+0:+1:x",
                           "+0:+1:1:1", "a:+1:1", "+0:b:1", "+0:+1:1e999", "+0:+1:end"}) {
    const auto times = parseTimes(text);
    ASSERT_FALSE(times) << text;
    EXPECT_EQ(times.error().code, ExitCode::Usage);
    EXPECT_THAT(times.error().message, testing::StartsWith("--times")) << text;
  }
  for (const char* text : {"+1:+0:1", "+0:+11:1", "0:end:1", "start:end:0.0001", "start:end:0.000000001"}) {
    EXPECT_THAT(instants(text), testing::IsEmpty()) << text;
  }
}

TEST(PictureSequence, RefusesInTheWordsOfTheUser) {
  const auto refusal = [](std::string_view text) {
    const auto times = resolveTimes(*parseTimes(text), kSeconds);
    return times ? "" : times.error().message;
  };
  EXPECT_EQ(refusal("+3:+1.5:1"), "--times: +1.5 is before +3");
  EXPECT_EQ(refusal("end:start:1"), "--times: start is before end");
  EXPECT_EQ(refusal("+3:+10.25:1"), "--times: +10.25 is outside the recording, which spans +0 to +10");
  EXPECT_EQ(refusal("7:end:1"), "--times: 7 is outside the recording, which spans 1000000000 to 11000000000");
}

TEST(NumberedNames, StandWhereThePatternSaysSo) {
  EXPECT_EQ(NumberedName::parse("frame_%05d.png")->at(7), "frame_00007.png");
  EXPECT_EQ(NumberedName::parse("frame_%05d.png")->at(1234567), "frame_1234567.png");
  EXPECT_EQ(NumberedName::parse("%d.exr")->at(0), "0.exr");
  EXPECT_EQ(NumberedName::parse("100%%/%02d/a.png")->at(3), "100%/03/a.png");
}

TEST(NumberedNames, RefuseWhatIsNoPattern) {
  for (const char* text : {"a.png", "%d%d.png", "%s.png", "%5d.png", "%-5d.png", "%.5d.png", "%x.png", "a%", "a%0d.png",
                           "%099999d.png", "%n%d.png", "%%d.png", "%1$d.png"}) {
    EXPECT_FALSE(NumberedName::parse(text)) << text;
  }
}

}  // namespace
}  // namespace stillframe::cli
