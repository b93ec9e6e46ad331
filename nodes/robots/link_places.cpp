#include "nodes/robots/link_places.h"

namespace stillframe::nodes {

std::vector<std::optional<LinkPlace>> placeLinks(const Robot& robot, std::span<const LinkByTf> by_tf,
                                                 const JointPoses& joints) {
  std::vector<std::optional<LinkPlace>> places(robot.links.size());
  for (std::uint32_t i = 0; i < robot.links.size(); ++i) {
    if (by_tf[i] == LinkByTf::Placed) {
      places[i] = LinkPlace{i, {}};
    }
  }
  const auto jointAbove = [&](std::size_t link) -> const RobotJoint* {
    const std::int32_t joint = robot.links[link].parent_joint;
    return joint >= 0 && joints.parent_from_child[static_cast<std::size_t>(joint)]
               ? &robot.joints[static_cast<std::size_t>(joint)]
               : nullptr;
  };
  const auto parentFromChild = [&](std::size_t link) {
    return *joints.parent_from_child[static_cast<std::size_t>(robot.links[link].parent_joint)];
  };
  const auto placeDown = [&] {
    for (std::size_t i = 0; i < places.size(); ++i) {  // parents come first
      const RobotJoint* const joint = by_tf[i] == LinkByTf::Unknown && !places[i] ? jointAbove(i) : nullptr;
      if (joint != nullptr && places[joint->parent_link]) {
        const LinkPlace& parent = *places[joint->parent_link];
        places[i] = LinkPlace{parent.seed, parent.seed_from_link * parentFromChild(i)};
      }
    }
  };
  placeDown();
  for (std::size_t i = places.size(); i-- > 0;) {
    const RobotJoint* const joint = places[i] ? jointAbove(i) : nullptr;
    if (joint != nullptr && by_tf[joint->parent_link] == LinkByTf::Unknown && !places[joint->parent_link]) {
      places[joint->parent_link] =
          LinkPlace{places[i]->seed, places[i]->seed_from_link * tf::inverse(parentFromChild(i))};
    }
  }
  placeDown();
  return places;
}

}  // namespace stillframe::nodes
