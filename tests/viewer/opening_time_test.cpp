#include "viewer/time/opening_time.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/builders.h"

namespace stillframe::viewer {
namespace {

using namespace tf::literals;
using scenegraph::ObjectType;
using test::CloudBuilder;
using test::DatasetBuilder;
using tf::TimePoint;

constexpr std::int64_t kMs = 1'000'000;

scenegraph::PointCloud cloud() { return CloudBuilder("lidar").xyz().point({1.0, 2.0, 3.0}).build(); }

TimePoint openingOf(const std::shared_ptr<scenegraph::Dataset>& dataset) {
  const auto range = *dataset->timeRange();
  return openingTime(dataset->store(), {range.first, range.second});
}

/// Transforms from 0 to `end`, and a topic of clouds from `first` on.
DatasetBuilder drive(std::int64_t end_ns, std::int64_t first_ns) {
  DatasetBuilder builder;
  builder.topic("/tf", ObjectType::FrameTransforms);
  builder.transform(0, "map", "lidar").transform(end_ns, "map", "lidar");
  builder.topic("/points", ObjectType::PointCloud).at(first_ns, cloud());
  return builder;
}

TEST(OpeningTime, IsWhenAllTopicsOfTheBeginningHaveBegun) {
  auto builder = drive(20_s, 100 * kMs);
  builder.topic("/scan", ObjectType::PointCloud).at(400 * kMs, cloud());
  builder.topic("/late", ObjectType::PointCloud).at(15_s, cloud());
  EXPECT_EQ(openingOf(builder.build()), TimePoint{400 * kMs}) << "not 15 s into the recording";
}

TEST(OpeningTime, IsTheStartWhereEverythingIsThere) {
  EXPECT_EQ(openingOf(drive(20_s, 0).build()), TimePoint{0});
  EXPECT_EQ(openingOf(drive(0, 0).build()), TimePoint{0}) << "one instant";
}

TEST(OpeningTime, IsTheFirstMessageWhereTransformsAreAloneForLong) {
  EXPECT_EQ(openingOf(drive(100_s, 70_s).build()), TimePoint{70_s});
}

TEST(OpeningTime, OfTransformsAloneIsWhereTheirTopicsHaveBegun) {
  DatasetBuilder builder;
  builder.topic("/tf", ObjectType::FrameTransforms);
  builder.transform(5_s, "map", "base").transform(9_s, "map", "base");
  EXPECT_EQ(openingOf(builder.build()), TimePoint{5_s});
}

TEST(OpeningTime, WaitsAtMostATenthOfAShortRecordingAndTwoSecondsOfALongOne) {
  auto brief = drive(1_s, 0);
  brief.topic("/scan", ObjectType::PointCloud).at(150 * kMs, cloud());
  EXPECT_EQ(openingOf(brief.build()), TimePoint{0});
  auto lengthy = drive(3600_s, 0);
  lengthy.topic("/scan", ObjectType::PointCloud).at(1999 * kMs, cloud());
  lengthy.topic("/slow", ObjectType::PointCloud).at(2001 * kMs, cloud());
  EXPECT_EQ(openingOf(lengthy.build()), TimePoint{1999 * kMs});
}

TEST(OpeningTime, HoldsAtBothEndsOfTime) {
  constexpr std::int64_t kFirst = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
  DatasetBuilder builder;
  builder.topic("/points", ObjectType::PointCloud).at(kFirst, cloud()).at(kLast, cloud());
  EXPECT_EQ(openingOf(builder.build()), TimePoint{kFirst});
  scenegraph::ObjectStore nothing;
  EXPECT_EQ(openingTime(nothing, {TimePoint{3}, TimePoint{9}}), TimePoint{3});
}

}  // namespace
}  // namespace stillframe::viewer
