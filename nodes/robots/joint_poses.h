#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "nodes/robots/robot.h"
#include "scenegraph/objects/robot_description.h"

namespace stillframe::nodes {

/// Joint positions that a message tells, by joint.
using JointPositions = std::unordered_map<std::string, double>;
[[nodiscard]] JointPositions jointPositions(const scenegraph::JointStates& states);

/// What forward kinematics makes of joint positions.
struct JointPoses {
  std::vector<std::optional<tf::RigidTransform>> parent_from_child;  ///< one a joint; absent: its position is unknown
  std::size_t clamped = 0;                                           ///< joints that were beyond their limits
  std::size_t unknown = 0;                                           ///< movable joints without a position
};

/// Poses of all joints: fixed ones by their origin, mimics by the joint that they follow, others by their position,
/// clamped to the limits. Planar and floating joints have no single position: theirs is unknown, or zero when
/// `unknown_is_zero`. Mimics that follow one another in a circle are unknown.
[[nodiscard]] JointPoses poseJoints(const Robot& robot, const JointPositions& positions, bool unknown_is_zero);

}  // namespace stillframe::nodes
