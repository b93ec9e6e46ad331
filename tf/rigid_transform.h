#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace stillframe::tf {

/// A rotation followed by a translation, in double: p_target = rotation * p_source + translation.
///
/// Values are named `target_from_source`. `rotation` is a unit quaternion (glm order: w, x, y, z); everything that
/// stores one has normalised it on entry.
struct RigidTransform {
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 translation{0.0, 0.0, 0.0};
};

/// c_from_a = c_from_b * b_from_a.
[[nodiscard]] RigidTransform operator*(const RigidTransform& c_from_b, const RigidTransform& b_from_a) noexcept;
/// a_from_b for a given b_from_a.
[[nodiscard]] RigidTransform inverse(const RigidTransform& b_from_a) noexcept;
[[nodiscard]] glm::dvec3 transformPoint(const RigidTransform& target_from_source,
                                        const glm::dvec3& point_in_source) noexcept;
/// Column-major homogeneous matrix, for glm and OSG.
[[nodiscard]] glm::dmat4 toMatrix(const RigidTransform& target_from_source) noexcept;
/// Roll, pitch and yaw in radians: about the fixed X, Y and Z axes in turn, as ROS has it. At a pitch of 90 degrees,
/// where roll and yaw are one and the same turn, all of it is given as yaw.
[[nodiscard]] glm::dvec3 rollPitchYaw(const glm::dquat& rotation) noexcept;
[[nodiscard]] bool isFinite(const RigidTransform& transform) noexcept;

}  // namespace stillframe::tf
