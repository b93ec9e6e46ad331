#include "nodes/poses/pose_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/nodes/poses/poses_builder.h"

namespace stillframe::nodes {
namespace {

using scenegraph::PosesInFrame;
using scenegraph::PosesKind;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

PoseSet setOf(PosesInFrame message) { return PoseSet(std::make_shared<const PosesInFrame>(std::move(message))); }

TEST(PoseSet, JudgesPlacesAndRotations) {
  const PoseSet set = setOf(test::posesOf(PosesKind::Array, {{.rotation = {0.0, 0.0, 0.0, 0.0}},
                                                             {.rotation = {kNan, 0.0, 0.0, 1.0}},
                                                             {.rotation = {1e-300, 0.0, 0.0, 1e-300}},
                                                             {.translation = {kInfinity, 0.0, 0.0}},
                                                             {.translation = {0.0, 1e200, 0.0}},
                                                             {}}));
  EXPECT_EQ(set.faults().zero_rotations, 1U);
  EXPECT_EQ(set.faults().bad_rotations, 1U);
  EXPECT_EQ(set.faults().unnormalised, 1U);
  EXPECT_EQ(set.faults().not_finite, 1U);
  EXPECT_EQ(set.faults().out_of_reach, 1U);
  EXPECT_EQ(set.pose(0)->rotation, glm::dquat(1.0, 0.0, 0.0, 0.0)) << "as RViz takes it";
  EXPECT_FALSE(set.pose(1));
  EXPECT_TRUE(set.point(1)) << "it has a place";
  EXPECT_NEAR(set.pose(2)->rotation.z, std::sqrt(0.5), 1e-15) << "a quarter turn, however short";
  EXPECT_FALSE(set.point(3));
  EXPECT_FALSE(set.point(4));
}

TEST(PoseSet, TakesFarPlacesAboutTheirMiddle) {
  EXPECT_EQ(setOf(test::pointsOf(PosesKind::Path, {{0, 0, 0}, {100, -900, 5}})).origin(), glm::dvec3(0.0));
  const PoseSet far =
      setOf(test::pointsOf(PosesKind::Path, {{4'200'000.001, 470'000, 10}, {4'200'001.001, 470'002, 12}}));
  EXPECT_EQ(far.origin(), glm::dvec3(4'200'000.501, 470'001, 0));
  const auto& points = *far.line(PoseValue::None).arrays.points;
  EXPECT_NEAR(points[0].x(), -0.5, 1e-6);
  EXPECT_NEAR(points[1].z(), 12.0, 1e-6);
  EXPECT_TRUE(far.line(PoseValue::X).limits == (ValueRange{4'200'000.001, 4'200'001.001}));
}

TEST(PoseSet, GivesLinesTheirValuesOnce) {
  const PoseSet set = setOf(test::pointsOf(PosesKind::Path, {{0, 0, 7}, {1, 0, 8}, {2, kNan, 9}, {3, 0, 10}}));
  const PoseSet::Line& by_time = set.line(PoseValue::Time);
  EXPECT_EQ(&by_time, &set.line(PoseValue::Time));
  EXPECT_EQ(by_time.limits, (ValueRange{0.0, 3.0}));
  EXPECT_EQ(by_time.arrays.segments, 1U) << "the break, and a point alone";
  EXPECT_EQ(by_time.arrays.not_finite, 1U);
  EXPECT_EQ((*by_time.arrays.values)[1], 1.0F);
  EXPECT_EQ(set.line(PoseValue::Z).limits, (ValueRange{7.0, 10.0}));
  EXPECT_FALSE(set.line(PoseValue::None).arrays.values.valid());

  PosesInFrame still = test::pointsOf(PosesKind::Path, {{0, 0, 0}, {1, 0, 0}});
  still.stamps = {{5}, {5}};
  const PoseSet timeless = setOf(std::move(still));
  EXPECT_FALSE(timeless.hasTimes());
  EXPECT_EQ(timeless.line(PoseValue::Time).limits, (ValueRange{0.0, 1.0})) << "by order";
}

TEST(PoseSet, SurvivesEmptyMessagesAndStampsThatDoNotFit) {
  const PoseSet empty = setOf(test::posesOf(PosesKind::Path, {}));
  EXPECT_EQ(empty.line(PoseValue::Time).arrays.segments, 0U);
  EXPECT_EQ(empty.origin(), glm::dvec3(0.0));
  EXPECT_TRUE(empty.fill()->empty());
  PosesInFrame short_stamps = test::pointsOf(PosesKind::Path, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  short_stamps.stamps = {{std::numeric_limits<std::int64_t>::min()}, {std::numeric_limits<std::int64_t>::max()}};
  EXPECT_FALSE(setOf(short_stamps).hasTimes());
  short_stamps.stamps.push_back({0});
  EXPECT_TRUE(std::isfinite(setOf(std::move(short_stamps)).line(PoseValue::Time).limits.high));
}

TEST(PoseSet, FillsPolygonsThatCanBeDrawn) {
  EXPECT_EQ(setOf(test::pointsOf(PosesKind::Polygon, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})).fill()->size(), 6U);
  EXPECT_EQ(setOf(test::pointsOf(PosesKind::Polygon, {{0, 0, 0}, {1, 0, 0}, {kNan, 1, 0}})).fill(), nullptr);
  EXPECT_EQ(setOf(test::pointsOf(PosesKind::Polygon, std::vector<glm::dvec3>(5000))).fill(), nullptr);
}

}  // namespace
}  // namespace stillframe::nodes
