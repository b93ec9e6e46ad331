#include "tools/cli/time_argument.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <optional>

namespace stillframe::cli {
namespace {

using tf::TimePoint;

constexpr std::int64_t kLowest = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kHighest = std::numeric_limits<std::int64_t>::max();
constexpr std::pair kRange{TimePoint{1'700'000'000'000'000'000}, TimePoint{1'700'000'010'000'000'000}};

std::optional<std::int64_t> resolved(std::string_view text, const std::pair<TimePoint, TimePoint>& range = kRange) {
  const auto time = parseTime(text);
  if (!time) {
    return std::nullopt;
  }
  const auto point = resolveTime(*time, range);
  return point ? std::optional(point->ns) : std::nullopt;
}

TEST(TimeArgument, ReadsNanosecondsOfTheWholeRange) {
  EXPECT_EQ(resolved("1700000000000000001"), 1'700'000'000'000'000'001);
  EXPECT_EQ(resolved("0"), 0);
  EXPECT_EQ(resolved("-1"), -1);
  EXPECT_EQ(resolved("9223372036854775807"), kHighest);
  EXPECT_EQ(resolved("-9223372036854775808"), kLowest);
}

TEST(TimeArgument, KnowsStartAndEnd) {
  EXPECT_EQ(resolved("start"), kRange.first.ns);
  EXPECT_EQ(resolved("end"), kRange.second.ns);
}

TEST(TimeArgument, AddsSecondsToTheStartExactly) {
  EXPECT_EQ(resolved("+0"), kRange.first.ns);
  EXPECT_EQ(resolved("+12.5"), kRange.first.ns + 12'500'000'000);
  EXPECT_EQ(resolved("+.5"), kRange.first.ns + 500'000'000);
  EXPECT_EQ(resolved("+3."), kRange.first.ns + 3'000'000'000);
  EXPECT_EQ(resolved("+0.1"), kRange.first.ns + 100'000'000);
  EXPECT_EQ(resolved("+0.000000001"), kRange.first.ns + 1);
  EXPECT_EQ(resolved("+1.00000000100000"), kRange.first.ns + 1'000'000'001);
  // A double has no room for this many digits.
  EXPECT_EQ(resolved("+123456789.123456789"), kRange.first.ns + 123'456'789'123'456'789);
}

TEST(TimeArgument, RefusesWhatDoesNotFit) {
  for (const char* text : {"9223372036854775808", "-9223372036854775809", "+9223372037", "+99999999999999999999"}) {
    const auto time = parseTime(text);
    ASSERT_FALSE(time) << text;
    EXPECT_EQ(time.error().code, ExitCode::Usage);
    EXPECT_THAT(time.error().message, testing::HasSubstr("64-bit")) << text;
  }
  EXPECT_EQ(resolved("+1", {TimePoint{kHighest}, TimePoint{kHighest}}), std::nullopt);
  EXPECT_EQ(resolved("+9223372036.854775807", {TimePoint{0}, TimePoint{1}}), kHighest);
}

TEST(TimeArgument, RefusesWhatIsNoTime) {
  for (const char* text : {"", "+", "-", "+.", "now", "1.5", "1e9", "+1e3", "+-1", "0x10", " 1", "1 ", "+1.0000000001",
                           "START", "nan", "+nan", "+1.2.3"}) {
    EXPECT_FALSE(parseTime(text)) << text;
  }
}

TEST(TimeArgument, WritesSecondsExactly) {
  EXPECT_EQ(secondsText(0), "0.000000000");
  EXPECT_EQ(secondsText(1'500'000'001), "1.500000001");
  EXPECT_EQ(secondsText(-1), "-0.000000001");
  EXPECT_EQ(secondsText(kLowest), "-9223372036.854775808");
}

}  // namespace
}  // namespace stillframe::cli
