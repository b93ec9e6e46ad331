#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "nodes/robots/joint_poses.h"
#include "nodes/robots/robot.h"

namespace stillframe::nodes {

/// What transforms say of a link.
enum class LinkByTf : std::uint8_t {
  Placed,   ///< its frame has a place
  Unknown,  ///< there is no such frame, or it hangs on nothing: kinematics may place it
  Absent,   ///< it has a place at other times: not placed, and nothing is placed through it
};

/// Where a link lies: relative to one that transforms place.
struct LinkPlace {
  std::uint32_t seed = 0;  ///< a link that is Placed
  tf::RigidTransform seed_from_link;
};

/// Places of all links: their own where transforms place them, else by the joints from the link nearest up or down the
/// tree that has one, as far as poses of joints are known. O(links).
[[nodiscard]] std::vector<std::optional<LinkPlace>> placeLinks(const Robot& robot, std::span<const LinkByTf> by_tf,
                                                               const JointPoses& joints);

}  // namespace stillframe::nodes
