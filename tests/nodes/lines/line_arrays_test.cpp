#include "nodes/lines/line_arrays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace stillframe::nodes {
namespace {

using Kind = LineBuilder::Kind;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

LineArrays build(Kind kind, const std::vector<glm::dvec3>& points) {
  LineBuilder lines;
  lines.begin(kind);
  for (const glm::dvec3& point : points) {
    lines.add(point);
  }
  lines.end();
  return lines.take();
}

/// x of each point and its flags (1: drawn, 2: joint).
std::vector<std::pair<float, int>> flags(const LineArrays& lines) {
  std::vector<std::pair<float, int>> result;
  for (const osg::Vec4& point : *lines.points) {
    result.emplace_back(point.x(), static_cast<int>(point.w()) & 3);
  }
  return result;
}

using Flags = std::vector<std::pair<float, int>>;

TEST(LineBuilder, JoinsAStripAtItsInnerPoints) {
  const LineArrays lines = build(Kind::Strip, {{0, 0, 0}, {1, 0, 0}, {2, 1, 5}});
  EXPECT_EQ(flags(lines), (Flags{{0, 0}, {1, 3}, {2, 1}}));
  EXPECT_EQ(lines.segments, 2U);
  EXPECT_EQ(lines.box._max, osg::Vec3d(2, 1, 5));
}

TEST(LineBuilder, ClosesALoopAndAStripThatEndsWhereItBegan) {
  const Flags closed{{0, 2}, {1, 3}, {2, 3}, {0, 3}};
  EXPECT_EQ(flags(build(Kind::Loop, {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}})), closed);
  EXPECT_EQ(flags(build(Kind::Loop, {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {0, 0, 0}})), closed);
  EXPECT_EQ(flags(build(Kind::Strip, {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {0, 0, 0}})), closed);
  EXPECT_EQ(flags(build(Kind::Loop, {{0, 0, 0}})), (Flags{{0, 0}}));
  EXPECT_EQ(flags(build(Kind::Strip, {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}})), (Flags{{0, 0}, {1, 3}, {0, 1}}))
      << "there and back is no loop";
}

TEST(LineBuilder, DrawsPairsOfAListWithoutJoints) {
  const LineArrays lines =
      build(Kind::List, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 0}, {3, 0, 0}, {kNan, 0, 0}, {4, 0, 0}, {5, 0, 0}});
  EXPECT_EQ(flags(lines), (Flags{{0, 0}, {1, 1}, {4, 0}, {5, 1}}));
  EXPECT_EQ(lines.segments, 2U);
  EXPECT_EQ(lines.not_finite, 1U);
  EXPECT_EQ(flags(build(Kind::List, {{0, 0, 0}, {1, 0, 0}, {9, 0, 0}})), (Flags{{0, 0}, {1, 1}})) << "half a pair";
}

TEST(LineBuilder, BreaksAtPointsThatAreNoPlace) {
  const double infinity = std::numeric_limits<double>::infinity();
  const LineArrays lines =
      build(Kind::Strip, {{kNan, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, infinity, 0}, {2, 0, 0}, {3, 0, 0}, {0, 0, -1e16}});
  EXPECT_EQ(flags(lines), (Flags{{0, 0}, {1, 1}, {2, 0}, {3, 1}}));
  EXPECT_EQ(lines.not_finite, 2U);
  EXPECT_EQ(lines.out_of_reach, 1U);
  EXPECT_EQ(flags(build(Kind::Loop, {{0, 0, 0}, {1, 0, 0}, {kNan, 0, 0}, {2, 0, 0}})),
            (Flags{{0, 2}, {1, 1}, {2, 0}, {0, 3}}))
      << "the rest of the loop goes on across its beginning";
  EXPECT_EQ(flags(build(Kind::Loop, {{0, 0, 0}, {1, 0, 0}, {kNan, 0, 0}})), (Flags{{0, 0}, {1, 1}}));
  EXPECT_EQ(flags(build(Kind::Loop, {{kNan, 0, 0}, {1, 0, 0}, {2, 0, 0}})), (Flags{{1, 0}, {2, 1}}));
}

TEST(LineBuilder, LeavesOutSegmentsWithoutLength) {
  const LineArrays lines = build(Kind::Strip, {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 0}});
  EXPECT_EQ(flags(lines), (Flags{{0, 0}, {1, 3}, {2, 1}}));
  EXPECT_EQ(build(Kind::Strip, {{1, 1, 1}, {1, 1, 1}}).segments, 0U);
  EXPECT_FALSE(build(Kind::Strip, {{1, 1, 1}, {1, 1, 1}}).box.valid());
}

TEST(LineBuilder, KeepsMillimetresOnTheFarSideOfTheEarth) {
  const glm::dvec3 place{4'200'000.0, 470'000.0, 4'780'000.0};
  LineBuilder lines(place);
  lines.begin(Kind::Strip);
  lines.add(place + glm::dvec3(0.001, 0, 0));
  lines.add(place + glm::dvec3(0.002, 0, 0));
  lines.end();
  const LineArrays arrays = lines.take();
  EXPECT_NEAR((*arrays.points)[0].x(), 0.001, 1e-9);
  EXPECT_NEAR((*arrays.points)[1].x(), 0.002, 1e-9);
}

TEST(LineBuilder, NumbersStylesByFirstUseAndStartsAnewAfterTake) {
  LineBuilder lines({}, LineBuilder::Channel::Values);
  for (const LineStyle& style : {LineStyle{2.0, false}, LineStyle{2.0, true}, LineStyle{2.0, false}}) {
    lines.begin(Kind::Strip, style);
    lines.add({0, 0, 0}, {}, 1.0F);
    lines.add({1, 0, 0}, {}, std::numeric_limits<float>::quiet_NaN());
    lines.end();
  }
  const LineArrays arrays = lines.take();
  ASSERT_EQ(arrays.styles->size(), 2U);
  EXPECT_EQ((*arrays.styles)[1], osg::Vec4(2, 1, 0, 0));
  EXPECT_EQ(static_cast<int>((*arrays.points)[3].w()), 4 + 1);
  EXPECT_EQ(static_cast<int>((*arrays.points)[5].w()), 1);
  ASSERT_EQ(arrays.values->size(), 6U);
  EXPECT_TRUE(std::isfinite((*arrays.values)[1]));
  EXPECT_FALSE(arrays.colors.valid());
  EXPECT_EQ(lines.take().points->size(), 0U);
}

}  // namespace
}  // namespace stillframe::nodes
