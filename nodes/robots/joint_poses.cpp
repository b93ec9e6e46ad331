#include "nodes/robots/joint_poses.h"

#include <algorithm>
#include <cmath>

namespace stillframe::nodes {
namespace {

/// The position of a joint, following mimics.
std::optional<double> positionOf(const Robot& robot, const JointPositions& positions, const RobotJoint& joint) {
  double scale = 1.0;
  double offset = 0.0;
  const RobotJoint* at = &joint;
  for (std::size_t steps = 0; steps <= robot.joints.size(); ++steps) {
    if (const auto told = positions.find(at->name); told != positions.end()) {
      return scale * told->second + offset;
    }
    if (!at->mimic) {
      return std::nullopt;
    }
    offset += scale * at->mimic->offset;
    scale *= at->mimic->multiplier;
    at = &robot.joints[at->mimic->joint];
  }
  return std::nullopt;  // a circle
}

tf::RigidTransform motion(const RobotJoint& joint, double position) {
  if (joint.kind == RobotJointKind::Prismatic) {
    return {.translation = position * joint.axis};
  }
  return {.rotation = glm::angleAxis(position, joint.axis)};
}

}  // namespace

JointPositions jointPositions(const scenegraph::JointStates& states) {
  JointPositions positions;
  for (std::size_t i = 0; i < std::min(states.names.size(), states.positions.size()); ++i) {
    if (std::isfinite(states.positions[i])) {
      positions.insert_or_assign(states.names[i], states.positions[i]);
    }
  }
  return positions;
}

JointPoses poseJoints(const Robot& robot, const JointPositions& positions, bool unknown_is_zero) {
  JointPoses poses;
  poses.parent_from_child.reserve(robot.joints.size());
  for (const RobotJoint& joint : robot.joints) {
    if (joint.kind == RobotJointKind::Fixed) {
      poses.parent_from_child.emplace_back(joint.parent_from_joint);
      continue;
    }
    const bool has_position = joint.kind != RobotJointKind::Planar && joint.kind != RobotJointKind::Floating;
    auto position = has_position ? positionOf(robot, positions, joint) : std::nullopt;
    if (!position || !std::isfinite(*position)) {
      ++poses.unknown;
      if (!unknown_is_zero) {
        poses.parent_from_child.emplace_back(std::nullopt);
        continue;
      }
      position = 0.0;
    }
    if (joint.limits) {
      const double kept = std::clamp(*position, joint.limits->lower, joint.limits->upper);
      poses.clamped += kept != *position ? 1 : 0;
      position = kept;
    }
    poses.parent_from_child.emplace_back(joint.parent_from_joint * motion(joint, *position));
  }
  return poses;
}

}  // namespace stillframe::nodes
