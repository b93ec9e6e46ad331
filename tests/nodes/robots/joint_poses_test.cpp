#include "nodes/robots/joint_poses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace stillframe::nodes {
namespace {

RobotJoint joint(const std::string& name, RobotJointKind kind) {
  return {.name = name, .kind = kind, .parent_from_joint = {.translation = {1, 0, 0}}, .axis = {0, 0, 1}};
}

TEST(JointPoses, TurnsAndMovesAlongTheAxisOfTheJoint) {
  Robot robot;
  robot.joints = {joint("turn", RobotJointKind::Revolute), joint("slide", RobotJointKind::Prismatic),
                  joint("fixed", RobotJointKind::Fixed)};
  const auto poses = poseJoints(robot, {{"turn", std::acos(-1.0) / 2}, {"slide", 2.0}}, false);
  const auto at = [&](std::size_t i) { return tf::transformPoint(poses.parent_from_child[i].value(), {1, 0, 0}); };
  EXPECT_LT(glm::length(at(0) - glm::dvec3(1, 1, 0)), 1e-12);
  EXPECT_LT(glm::length(at(1) - glm::dvec3(2, 0, 2)), 1e-12);
  EXPECT_LT(glm::length(at(2) - glm::dvec3(2, 0, 0)), 1e-12);
  EXPECT_EQ(poses.unknown + poses.clamped, 0U);
}

TEST(JointPoses, ClampsToLimitsAndFollowsMimics) {
  Robot robot;
  robot.joints = {joint("a", RobotJointKind::Prismatic), joint("b", RobotJointKind::Prismatic),
                  joint("c", RobotJointKind::Prismatic)};
  robot.joints[0].limits = {-1, 1};
  robot.joints[1].mimic = {.joint = 0, .multiplier = -2, .offset = 0.5};
  robot.joints[2].mimic = {.joint = 1, .multiplier = 10, .offset = 1};
  const auto poses = poseJoints(robot, {{"a", 3.0}}, false);
  EXPECT_EQ(poses.clamped, 1U);
  EXPECT_DOUBLE_EQ(poses.parent_from_child[0]->translation.z, 1.0);
  EXPECT_DOUBLE_EQ(poses.parent_from_child[1]->translation.z, -5.5);
  EXPECT_DOUBLE_EQ(poses.parent_from_child[2]->translation.z, -54.0);
}

TEST(JointPoses, WhatIsNotToldIsUnknown) {
  Robot robot;
  robot.joints = {joint("a", RobotJointKind::Revolute), joint("b", RobotJointKind::Revolute),
                  joint("planar", RobotJointKind::Planar)};
  robot.joints[0].mimic = {.joint = 1};
  robot.joints[1].mimic = {.joint = 0};  // a circle
  const auto poses = poseJoints(robot, {{"planar", 1.0}}, false);
  EXPECT_EQ(poses.unknown, 3U);
  EXPECT_FALSE(poses.parent_from_child[0]);
  const auto zero = poseJoints(robot, {}, true);
  EXPECT_DOUBLE_EQ(zero.parent_from_child[2]->translation.x, 1.0);
}

TEST(JointPoses, MessagesShorterThanTheirNamesOrNotFiniteTellNothing) {
  const auto positions = jointPositions(
      {.stamp = {}, .names = {"a", "b", "c"}, .positions = {1.0, std::numeric_limits<double>::quiet_NaN()}});
  EXPECT_EQ(positions.size(), 1U);
  EXPECT_EQ(positions.at("a"), 1.0);
}

}  // namespace
}  // namespace stillframe::nodes
