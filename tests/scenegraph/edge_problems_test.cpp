#include "scenegraph/store/edge_problems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/support/builders.h"

namespace stillframe::scenegraph {
namespace {

using test::TfBuilder;
using test::translate;
using test::turn;
using namespace tf::literals;

std::size_t count(const std::vector<Problem>& problems, const std::string& code) {
  return static_cast<std::size_t>(std::ranges::count(problems, code, &Problem::code));
}

const Problem& find(const std::vector<Problem>& problems, const std::string& code) {
  return *std::ranges::find(problems, code, &Problem::code);
}

/// A robot that drives 0.1 m every 100 ms.
TfBuilder drivenEdge(std::int64_t from_ns, std::int64_t to_ns) {
  TfBuilder builder;
  builder.edge("odom", "base");
  for (std::int64_t t = from_ns; t <= to_ns; t += 100_ms) {
    builder.at(t, translate(static_cast<double>(t) * 1e-9, 0, 0));
  }
  return builder;
}

TEST(EdgeProblems, ASteadyEdgeHasNone) {
  EXPECT_TRUE(edgeProblems(*drivenEdge(0, 20_s).build(), tf::TimePoint{20_s}).empty());
}

TEST(EdgeProblems, AGapIsAtItsLastSampleAndSaysHowLongItIs) {
  auto builder = drivenEdge(0, 5_s);
  for (std::int64_t t = 9_s; t <= 12_s; t += 100_ms) {
    builder.at(t, translate(5.0, 0, 0));
  }
  const auto problems = edgeProblems(*builder.build(), tf::TimePoint{12_s});
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].code, "TransformGap");
  EXPECT_EQ(problems[0].time, tf::TimePoint{5_s});
  EXPECT_NE(problems[0].message.find("4 s"), std::string::npos) << problems[0].message;
  EXPECT_NE(problems[0].message.find("'odom' -> 'base'"), std::string::npos);
}

TEST(EdgeProblems, AJumpIsAtTheSampleThatJumpedByPlaceOrByTurn) {
  auto builder = drivenEdge(0, 5_s);
  builder.at(5'100_ms, translate(9.0, 0, 0)).at(5'200_ms, turn(2.0, 9.0, 0, 0));
  const auto problems = edgeProblems(*builder.build(), tf::TimePoint{5'200_ms});
  ASSERT_EQ(count(problems, "TransformJump"), 2U);
  EXPECT_EQ(find(problems, "TransformJump").time, tf::TimePoint{5'100_ms});
}

TEST(EdgeProblems, AnEdgeThatEndsEarlyIsStaleFromThere) {
  const auto problems = edgeProblems(*drivenEdge(0, 5_s).build(), tf::TimePoint{30_s});
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].code, "StaleTransform");
  EXPECT_EQ(problems[0].time, tf::TimePoint{5_s});
}

TEST(EdgeProblems, StaticEdgesAreNeverAtFault) {
  TfBuilder builder;
  builder.edge("base", "lidar", true).at(0, translate(0, 0, 1)).at(40_s, translate(9, 9, 1));
  EXPECT_TRUE(edgeProblems(*builder.build(), tf::TimePoint{100_s}).empty());
}

TEST(EdgeProblems, ManyOnOneEdgeAreCountedRatherThanListed) {
  TfBuilder builder;
  builder.edge("odom", "base");
  for (std::int64_t second = 0; second < 2000; ++second) {
    builder.at(second * 100_ms, translate(second % 100 == 0 ? 50.0 : 0.0, 0, 0));
  }
  const auto problems = edgeProblems(*builder.build(), tf::TimePoint{200_s});
  EXPECT_EQ(count(problems, "TransformJump"), 8U);
  EXPECT_GT(problems[7].count, 20U);
}

TEST(EdgeProblems, TimesAtTheEndsOfTheirRangeAreSurvived) {
  TfBuilder builder;
  builder.edge("a", "b")
      .at(std::numeric_limits<std::int64_t>::min(), translate(0, 0, 0))
      .at(0, translate(1e300, -1e300, 0))
      .at(std::numeric_limits<std::int64_t>::max(), translate(0, 0, 0));
  builder.edge("a", "c").at(5, {});
  for (const std::int64_t end :
       {std::numeric_limits<std::int64_t>::min(), std::int64_t{0}, std::numeric_limits<std::int64_t>::max()}) {
    for (const Problem& problem : edgeProblems(*builder.build(), tf::TimePoint{end})) {
      EXPECT_TRUE(problem.time.has_value());
    }
  }
}

}  // namespace
}  // namespace stillframe::scenegraph
