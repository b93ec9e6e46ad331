#include "scenegraph/camera/box.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace stillframe::scenegraph {
namespace {

Box at(const glm::dvec3& centre, double half_m) { return {centre - half_m, centre + half_m}; }

TEST(BulkOfTest, NothingHasNone) {
  EXPECT_FALSE(bulkOf({}).isValid());
  EXPECT_FALSE(bulkOf(std::array{Box{}, Box{}}).isValid());
}

TEST(BulkOfTest, WhatLiesTogetherIsKeptWhole) {
  std::vector<Box> boxes;
  for (int i = 0; i < 40; ++i) {
    boxes.push_back(at({i * 1.0, -i * 2.0, 0.0}, 0.3));
  }
  const Box bulk = bulkOf(boxes);
  EXPECT_DOUBLE_EQ(bulk.low.x, -0.3);
  EXPECT_DOUBLE_EQ(bulk.high.x, 39.3);
  EXPECT_DOUBLE_EQ(bulk.low.y, -78.3);
}

TEST(BulkOfTest, OriginOfAProjectionFarFromItsRobotIsLeftOut) {
  const glm::dvec3 utm(455'000.0, 5'429'000.0, 110.0);
  const std::array boxes{at({}, 0.5), at(utm, 0.5), at(utm + glm::dvec3(4, 2, 0), 0.5), at(utm, 60.0)};
  const Box bulk = bulkOf(boxes);
  EXPECT_DOUBLE_EQ(bulk.low.x, utm.x - 60.0);
  EXPECT_DOUBLE_EQ(bulk.high.y, utm.y + 60.0);
}

TEST(BulkOfTest, OrderDoesNotMatter) {
  std::vector<Box> boxes{at({1e7, 0, 0}, 1.0), at({0, 3, 0}, 1.0), at({2, 0, 0}, 1.0), at({0, 0, 1}, 1.0)};
  const Box bulk = bulkOf(boxes);
  EXPECT_LT(bulk.high.x, 10.0);
  for (int i = 0; i < 4; ++i) {
    std::rotate(boxes.begin(), boxes.begin() + 1, boxes.end());
    EXPECT_EQ(bulkOf(boxes).low, bulk.low);
    EXPECT_EQ(bulkOf(boxes).high, bulk.high);
  }
}

TEST(BulkOfTest, HalfOrMoreAreNoStrays) {
  EXPECT_GT(bulkOf(std::array{at({}, 1.0), at({1e6, 0, 0}, 1.0)}).high.x, 1e6) << "neither can be told to be the stray";
  EXPECT_LT(bulkOf(std::array{at({}, 1.0), at({}, 1.0)}).high.x, 2.0);
}

TEST(BulkOfTest, LargeDataReachFarWithoutBeingStrays) {
  // A map of 20 km, and the frames of a robot near one of its corners.
  const std::array boxes{at({10'000, 10'000, 0}, 10'000.0), at({}, 0.5), at({1, 0, 0}, 0.5)};
  EXPECT_DOUBLE_EQ(bulkOf(boxes).high.x, 20'000.0);
}

TEST(BulkOfTest, PointsOfNoSizeAreKeptWhereTheyLieTogether) {
  EXPECT_DOUBLE_EQ(bulkOf(std::array{at({5, 0, 0}, 0.0)}).high.x, 5.0);
  EXPECT_DOUBLE_EQ(bulkOf(std::array{at({5, 0, 0}, 0.0), at({5, 0, 0}, 0.0), at({5, 0, 0}, 0.0)}).low.x, 5.0);
}

TEST(BulkOfTest, NumbersAtTheEndsOfTheirRangeAreBorne) {
  constexpr double kHuge = std::numeric_limits<double>::max();
  const Box bulk = bulkOf(std::array{at({}, 1.0), at({}, 2.0), at({kHuge, -kHuge, kHuge}, 0.0), Box{}});
  EXPECT_EQ(bulk.high.x, 2.0);
  EXPECT_EQ(bulk.low.y, -2.0);
}

}  // namespace
}  // namespace stillframe::scenegraph
