#include "nodes/points/value_histogram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <vector>

#include "nodes/points/channel.h"

namespace stillframe::nodes {
namespace {

std::uint64_t total(const scenegraph::ValueHistogram& histogram) {
  return std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::uint64_t{0});
}

TEST(ValueHistogram, CountsEveryValueOnceFromTheLeastToTheGreatest) {
  std::vector<float> values;
  for (int i = 0; i < 640; ++i) {
    values.push_back(static_cast<float>(i));
  }
  const auto histogram = histogramOf(values, 1000.0);
  EXPECT_EQ(histogram.low, 1000.0);
  EXPECT_EQ(histogram.high, 1639.0);
  ASSERT_EQ(histogram.counts.size(), kHistogramBins);
  EXPECT_EQ(total(histogram), 640U);
  EXPECT_THAT(histogram.counts, testing::Each(testing::AllOf(testing::Ge(9U), testing::Le(11U))));
}

TEST(ValueHistogram, LeavesOutWhatIsMissingOrInfinite) {
  const float missing = kMissingValue;
  const auto histogram = histogramOf(std::vector{missing, 1.0F, kValueReach, 3.0F, -kValueReach, missing}, 0.0);
  EXPECT_EQ(histogram.low, 1.0);
  EXPECT_EQ(histogram.high, 3.0);
  EXPECT_EQ(total(histogram), 2U);
  EXPECT_TRUE(histogramOf(std::vector{missing}, 0.0).counts.empty());
  EXPECT_TRUE(histogramOf({}, 0.0).counts.empty());
}

TEST(ValueHistogram, StandsRangesWithoutWidthAndBeyondAllSense) {
  const auto equal = histogramOf(std::vector{7.0F, 7.0F, 7.0F}, 0.0);
  EXPECT_EQ(equal.low, equal.high);
  EXPECT_EQ(equal.counts.front(), 3U);
  const float tiny = std::numeric_limits<float>::denorm_min();
  EXPECT_EQ(total(histogramOf(std::vector{0.0F, tiny}, 0.0)), 2U);
  EXPECT_EQ(total(histogramOf(std::vector{-9.9e36F, 9.9e36F}, 1e300)), 2U);
}

TEST(ValueHistogram, GoesAlongAnyDirection) {
  const std::vector<float> positions{1, 0, 0, 0, 2, 0, 0, 0, 3};
  const auto histogram = histogramAlong(positions, {0.0, 1.0, -1.0}, 10.0);
  EXPECT_EQ(histogram.low, 7.0);
  EXPECT_EQ(histogram.high, 12.0);
  EXPECT_EQ(total(histogram), 3U);
}

}  // namespace
}  // namespace stillframe::nodes
