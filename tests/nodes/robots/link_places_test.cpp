#include "nodes/robots/link_places.h"

#include <gtest/gtest.h>

namespace stillframe::nodes {
namespace {

/// A chain of `count` links, each 1 m along x from the one before.
Robot chainOf(std::uint32_t count) {
  Robot robot;
  for (std::uint32_t i = 0; i < count; ++i) {
    robot.links.push_back({.name = "link" + std::to_string(i), .parent_joint = static_cast<std::int32_t>(i) - 1});
    if (i > 0) {
      robot.joints.push_back({.name = "joint" + std::to_string(i),
                              .parent_link = i - 1,
                              .child_link = i,
                              .parent_from_joint = {.translation = {1, 0, 0}}});
    }
  }
  return robot;
}

using enum LinkByTf;

TEST(LinkPlaces, AreThoseOfTransformsWhereThereAreAny) {
  const Robot robot = chainOf(3);
  const auto places = placeLinks(robot, std::vector{Placed, Placed, Placed}, poseJoints(robot, {}, true));
  for (std::uint32_t i = 0; i < 3; ++i) {
    ASSERT_TRUE(places[i]);
    EXPECT_EQ(places[i]->seed, i);
    EXPECT_EQ(places[i]->seed_from_link.translation, glm::dvec3(0.0));
  }
}

TEST(LinkPlaces, ComeDownAndUpTheTreeFromTheNearestThatHasOne) {
  const Robot robot = chainOf(5);
  const auto places =
      placeLinks(robot, std::vector{Unknown, Unknown, Placed, Unknown, Unknown}, poseJoints(robot, {}, true));
  for (std::uint32_t i = 0; i < 5; ++i) {
    ASSERT_TRUE(places[i]) << i;
    EXPECT_EQ(places[i]->seed, 2U);
    EXPECT_NEAR(places[i]->seed_from_link.translation.x, static_cast<double>(i) - 2.0, 1e-12);
  }
}

TEST(LinkPlaces, StopAtJointsThatNobodyTellsAndAtLinksThatAreElsewhereNow) {
  Robot robot = chainOf(4);
  robot.joints[2].kind = RobotJointKind::Revolute;
  auto places = placeLinks(robot, std::vector{Placed, Unknown, Unknown, Unknown}, poseJoints(robot, {}, false));
  EXPECT_TRUE(places[2]);
  EXPECT_FALSE(places[3]);
  places = placeLinks(robot, std::vector{Placed, Absent, Unknown, Unknown}, poseJoints(robot, {}, true));
  EXPECT_FALSE(places[1]);
  EXPECT_FALSE(places[2]) << "nothing is placed through a link that has its place at other times";
}

TEST(LinkPlaces, OfNothingAreNoneAndOfALongChainAreExact) {
  EXPECT_TRUE(placeLinks({}, {}, {}).empty());
  constexpr std::uint32_t kLinks = 10'000;
  const Robot robot = chainOf(kLinks);
  std::vector<LinkByTf> by_tf(kLinks, Unknown);
  EXPECT_FALSE(placeLinks(robot, by_tf, poseJoints(robot, {}, true)).back());
  by_tf.front() = Placed;
  const auto places = placeLinks(robot, by_tf, poseJoints(robot, {}, true));
  ASSERT_TRUE(places.back());
  EXPECT_EQ(places.back()->seed_from_link.translation.x, kLinks - 1.0);
}

}  // namespace
}  // namespace stillframe::nodes
