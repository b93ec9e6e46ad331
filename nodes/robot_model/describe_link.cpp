// What RobotModelLayer says of itself: a link that is picked, its nodes, and shapes that could not be had.
#include <algorithm>

#include "nodes/robot_model/robot_model_layer.h"

namespace stillframe::nodes {
namespace {

constexpr std::size_t kMostNamedFaults = 3;

const char* shapeName(RobotShapeKind kind) {
  switch (kind) {
    case RobotShapeKind::Box:
      return "box";
    case RobotShapeKind::Cylinder:
      return "cylinder";
    case RobotShapeKind::Sphere:
      return "sphere";
    case RobotShapeKind::Capsule:
      return "capsule";
    case RobotShapeKind::Mesh:
      break;
  }
  return "mesh";
}

}  // namespace

std::optional<scenegraph::Picked> RobotModelLayer::describe(const scenegraph::PickHit& hit) const {
  const auto found = std::ranges::find_if(
      nodes_, [&](const LinkNode& link) { return link.anchor == hit.frame && hit.isBeneath(*link.node); });
  if (scene_ == nullptr || found == nodes_.end()) {
    return std::nullopt;
  }
  const RobotLink& link = scene_->robot().links[static_cast<std::size_t>(found - nodes_.begin())];
  scenegraph::Picked picked{.kind = "link",
                            .id = link.name,
                            .point_in_frame = scenegraph::surfacePoint(hit),
                            .stamp = std::nullopt,
                            .fields = {},
                            .radius_m = 1.0};
  picked.add("robot", scene_->robot().name);
  picked.add("frame", found->frame);
  picked.add("placed_by", std::string(found->frame == hit.frame ? "transforms" : "joints, from " + hit.frame));
  if (link.parent_joint >= 0) {
    picked.add("joint", scene_->robot().joints[static_cast<std::size_t>(link.parent_joint)].name);
  }
  // The nodes of its shapes come in the order of the description, those seen before those that collide.
  const osg::Node* const piece = hit.childOf(*found->node);
  const std::size_t visuals = settings_.visual ? link.visuals.size() : 0;
  for (unsigned i = 0; i < found->node->getNumChildren(); ++i) {
    const bool is_visual = i < visuals;
    const auto& shapes = is_visual ? link.visuals : link.collisions;
    const std::size_t number = is_visual ? i : i - visuals;
    if (found->node->getChild(i) == piece && number < shapes.size()) {
      picked.add("part", std::string(is_visual ? "visual" : "collision"));
      picked.add("shape", std::string(shapeName(shapes[number].kind)));
      if (!shapes[number].mesh_uri.empty()) {
        picked.add("mesh", shapes[number].mesh_uri);
      }
    }
  }
  picked.add("triangle", hit.primitive);
  return picked;
}

void RobotModelLayer::collectNodes(std::vector<osg::Node*>& nodes) const {
  for (const LinkNode& link : nodes_) {
    if (link.anchor) {
      nodes.push_back(link.node);
    }
  }
}

std::string RobotModelLayer::kinematicsText() const {
  const std::string links = std::to_string(tally_.by_kinematics) + " of " + std::to_string(nodes_.size()) +
                            " links are placed by the description's joints";
  if (tally_.is_at_zero) {
    return links + ", which stand at zero: " +
           (settings_.joints == "zero" ? "as set" : "there are neither transforms nor joint states for them");
  }
  const bool has_states = feed_ && feed_->sample() != nullptr && settings_.joints != "tf";
  return links + (has_states ? " and the joint states on '" + feed_->topic() + "'" : "") +
         (settings_.joints == "auto" ? ", for want of transforms" : "") +
         (tally_.clamped > 0 ? "; " + std::to_string(tally_.clamped) +
                                   (tally_.clamped == 1 ? " joint is beyond its limits and held there"
                                                        : " joints are beyond their limits and held there")
                             : "");
}

std::string RobotModelLayer::faultText() const {
  const auto& faults = scene_->faults();
  std::string text =
      std::to_string(faults.size()) + (faults.size() == 1 ? " of its shapes is a box in place of a mesh: "
                                                          : " of its shapes are boxes in place of meshes: ");
  for (std::size_t i = 0; i < std::min(faults.size(), kMostNamedFaults); ++i) {
    text += (i == 0 ? "link '" : "; link '") + faults[i].link + "': " + faults[i].status.message;
  }
  return text + (faults.size() > kMostNamedFaults ? "; and more" : "");
}

}  // namespace stillframe::nodes
