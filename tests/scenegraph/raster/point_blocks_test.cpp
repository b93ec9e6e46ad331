#include "scenegraph/raster/point_blocks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "scenegraph/raster/points_in_view.h"
#include "tests/scenegraph/raster/point_clusters.h"

namespace stillframe::scenegraph {
namespace {

using test::clusters;
using test::kInfinity;
using test::kNan;
using test::perspective;

TEST(PointsInView, TakesAsManyPassesAsThePointsSufficeFor) {
  const std::vector<float> cloud = clusters(60);
  const std::vector<PointBox> boxes = boxesOf(cloud);
  const PointBatch batch{.positions = cloud, .clip_from_points = perspective(0.1), .boxes = boxes};
  PointsInView in_view;
  in_view.add(batch, 160, 100);
  for (const std::uint32_t first : {0U, 1U, 700U, 1100U, 2000U}) {
    for (const double points : {0.0, 1.0, 500.0, 7777.0, 1e9}) {
      const std::uint32_t end = in_view.passesFor(points, first, kPassesOfBothLaps);
      ASSERT_GE(end, first);
      EXPECT_LE(in_view.drawnBefore(end) - in_view.drawnBefore(first), points);
      if (end < kPassesOfBothLaps) {
        EXPECT_GT(in_view.drawnBefore(end + 1) - in_view.drawnBefore(first), points);
      }
    }
  }
}

TEST(BoxOnScreen, HoldsEveryPointOfTheBoxAsItIsDrawn) {
  std::mt19937 random(21);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  int judged = 0;
  for (int i = 0; i < 3000; ++i) {
    const float reach = std::pow(10.0F, 3.0F * unit(random));
    const glm::dmat4 clip_from_points =
        perspective(0.01) * glm::rotate(glm::dmat4(1.0), 3.0 * unit(random), {0.2, 1.0, 0.1}) *
        glm::translate(glm::dmat4(1.0), 4.0 * reach * glm::dvec3(unit(random), unit(random), unit(random)));
    std::vector<float> points;
    for (int axis = 0; axis < 60; ++axis) {
      points.push_back(reach * unit(random));
    }
    const auto place = BoxProjector(clip_from_points, 1280, 720).project(boxesOf(points).front());
    if (!place) {
      continue;
    }
    ++judged;
    for (std::size_t at = 0; at < points.size(); at += 3) {
      const glm::vec4 clip = glm::mat4(clip_from_points) * glm::vec4(points[at], points[at + 1], points[at + 2], 1.0F);
      const glm::vec3 seen = glm::vec3(clip) * (1.0F / clip.w);
      if (std::abs(seen.x) > 1.0F || std::abs(seen.y) > 1.0F) {
        continue;
      }
      EXPECT_GE(seen.x * 640.0F + 640.0F, place->low_px.x);
      EXPECT_LE(seen.x * 640.0F + 640.0F, place->high_px.x);
      EXPECT_GE(seen.y * 360.0F + 360.0F, place->low_px.y);
      EXPECT_LE(seen.y * 360.0F + 360.0F, place->high_px.y);
      EXPECT_LE(seen.z, place->nearest);
      EXPECT_LE(1.0F / clip.w, place->most_per_w * (1.0 + 1e-6));
    }
  }
  EXPECT_GT(judged, 300);
}

TEST(BoxOnScreen, WhatCannotBeJudgedHasNoPlace) {
  const PointBox here{{-1.0F, -1.0F, -2.0F}, {1.0F, 1.0F, -1.0F}};
  const PointBox about_the_eye{{-1.0F, -1.0F, -1.0F}, {1.0F, 1.0F, 1.0F}};
  const PointBox everywhere{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  EXPECT_TRUE(BoxProjector(perspective(0.1), 100, 100).project(here));
  EXPECT_FALSE(BoxProjector(perspective(0.1), 100, 100).project(about_the_eye));
  EXPECT_FALSE(BoxProjector(perspective(0.1), 100, 100).project(everywhere));
  for (const double entry : {0.0, 1e300, static_cast<double>(kNan), static_cast<double>(kInfinity)}) {
    EXPECT_FALSE(BoxProjector(glm::dmat4(entry) - glm::dmat4(entry), 100, 100).project(here)) << entry;
  }
  EXPECT_EQ((BoxOnScreen{{0.0, 0.0}, {1e300, 1e300}}.pointsWorthDrawing(1.0)), kPassesOfSample);
  EXPECT_EQ((BoxOnScreen{{7.0, 7.0}, {7.0, 7.0}}.pointsWorthDrawing(1.0)), 4U);
  EXPECT_EQ((BoxOnScreen{{7.0, 7.0}, {7.0, 7.0}}.pointsWorthDrawing(kNan)), 4U);
}

TEST(PointBlocks, ABoxHoldsItsPointsButNoNan) {
  const std::vector<float> cloud{1.0F, 2.0F, 3.0F, kNan, -5.0F, 7.0F, -1.0F, 4.0F, kNan};
  const std::vector<PointBox> boxes = boxesOf(cloud);
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_THAT(boxes[0].low, testing::ElementsAre(-1.0F, -5.0F, 3.0F));
  EXPECT_THAT(boxes[0].high, testing::ElementsAre(1.0F, 4.0F, 7.0F));
  EXPECT_TRUE(boxesOf({}).empty());
}

TEST(PointBlocks, WhatCannotBeJudgedIsKept) {
  const PointBox everywhere{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  const PointBox here{{-1.0F, -1.0F, -2.0F}, {1.0F, 1.0F, -1.0F}};
  EXPECT_TRUE(BoxCull(perspective(0.1)).mayBeSeen(everywhere));
  for (const double entry : {static_cast<double>(kNan), static_cast<double>(kInfinity)}) {
    EXPECT_TRUE(BoxCull(glm::dmat4(entry)).mayBeSeen(here));
  }
  EXPECT_FALSE(BoxCull(perspective(0.1)).mayBeSeen({{-1.0F, -1.0F, 1.0F}, {1.0F, 1.0F, 2.0F}})) << "behind the eye";
  // A point on the very border, by whatever way it is computed.
  EXPECT_TRUE(BoxCull(perspective(0.1)).mayBeSeen({{1.0F, 0.0F, -1.0F}, {1.0F, 0.0F, -1.0F}}));
}

TEST(SampleOrder, EveryGroupGivesEachPointOnce) {
  for (const std::uint32_t group : {0U, 1U, 77U, 0xffffffffU}) {
    std::set<std::uint32_t> places;
    for (std::uint32_t pass = 0; pass < kPassesOfSample; ++pass) {
      places.insert(placeInGroup(group, pass));
    }
    EXPECT_EQ(places.size(), kPassesOfSample);
    EXPECT_EQ(*places.rbegin(), kPassesOfSample - 1);
  }
}

TEST(SampleOrder, BothLapsTogetherTakeEachPassOnceWhereverTheyAreCut) {
  for (std::uint32_t most = 1; most <= kPassesOfSample; most *= 2) {
    std::array<int, kPassesOfSample> taken{};
    std::uint32_t first = 0;
    for (const std::uint32_t end : {0U, 1U, 100U, 900U, 1024U, 1025U, 1400U, 2048U}) {
      const GroupTurns turns = turnsOf({first, end}, most);
      for (const PassRange& passes : {turns.first_lap, turns.second_lap}) {
        for (std::uint32_t pass = passes.first; pass < passes.end; ++pass) {
          ++taken[pass];
        }
      }
      first = end;
    }
    EXPECT_THAT(taken, testing::Each(1)) << most;
    EXPECT_EQ(turnsOf({0, kPassesOfSample}, most).count(), most);
  }
}

TEST(SampleOrder, APrefixTakesAsMuchOfEachRingAndOfEachStretch) {
  // 64 rings interleaved point by point, and 64 stretches one after another, of a million points.
  constexpr std::uint32_t kGroups = 1024;
  for (const std::uint32_t passes : {1U, 3U, 10U, 100U}) {
    std::array<std::uint32_t, 64> rings{};
    for (std::uint32_t group = 0; group < kGroups; ++group) {
      std::uint32_t early = 0;
      for (std::uint32_t pass = 0; pass < passes; ++pass) {
        const std::uint32_t place = placeInGroup(group, pass);
        ++rings[place % 64];
        early += place < kPassesOfSample / 2 ? 1 : 0;
      }
      EXPECT_LE(std::abs(2 * static_cast<int>(early) - static_cast<int>(passes)), 1) << "group " << group;
    }
    const double expected = static_cast<double>(kGroups) * passes / 64.0;
    for (const std::uint32_t taken : rings) {
      EXPECT_NEAR(taken, expected, 5.0 * std::sqrt(expected)) << passes << " passes";
    }
  }
}

}  // namespace
}  // namespace stillframe::scenegraph
