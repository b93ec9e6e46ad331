#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scenegraph/settings.h"
#include "tf/rigid_transform.h"

namespace stillframe::nodes {

enum class RobotShapeKind : std::uint8_t { Box, Cylinder, Sphere, Capsule, Mesh };

/// One visual or collision element of a link.
struct RobotShape {
  RobotShapeKind kind = RobotShapeKind::Box;
  /// Box: edges; cylinder and capsule: diameter twice, length along z (of a capsule without its half spheres); sphere:
  /// diameter three times; mesh: scale, negative where it is mirrored.
  glm::dvec3 size{1.0};
  std::string mesh_uri;  ///< Mesh
  tf::RigidTransform link_from_shape;
  std::optional<scenegraph::Color> color;  ///< of the URDF's material; absent: what the mesh says, else grey
  std::string texture_uri;                 ///< of the URDF's material
};

struct RobotLink {
  std::string name;
  std::int32_t parent_joint = -1;  ///< -1: the root
  std::vector<RobotShape> visuals = {};
  std::vector<RobotShape> collisions = {};
};

enum class RobotJointKind : std::uint8_t { Fixed, Revolute, Continuous, Prismatic, Planar, Floating };

struct RobotJoint {
  struct Limits {
    double lower = 0.0;
    double upper = 0.0;
  };
  struct Mimic {
    std::uint32_t joint = 0;
    double multiplier = 1.0;
    double offset = 0.0;
  };
  std::string name;
  RobotJointKind kind = RobotJointKind::Fixed;
  std::uint32_t parent_link = 0;
  std::uint32_t child_link = 0;
  tf::RigidTransform parent_from_joint;
  glm::dvec3 axis{1.0, 0.0, 0.0};     ///< unit, in the joint's frame
  std::optional<Limits> limits = {};  ///< of revolute and prismatic joints
  std::optional<Mimic> mimic = {};
};

/// A robot as its URDF describes it: a tree of links, parents before children, the root first.
struct Robot {
  std::string name;
  std::vector<RobotLink> links;
  std::vector<RobotJoint> joints;
  std::string remarks;  ///< what was left out and why, a sentence; "" as a rule

  [[nodiscard]] std::size_t byteSize() const noexcept;
};

}  // namespace stillframe::nodes
