#include "tf/rigid_transform.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "tf/wide_transform.h"

namespace stillframe::tf {

RigidTransform operator*(const RigidTransform& c_from_b, const RigidTransform& b_from_a) noexcept {
  return narrow(compose(widen(c_from_b), widen(b_from_a)));
}

RigidTransform inverse(const RigidTransform& b_from_a) noexcept {
  return narrow(composeInverse(widen(b_from_a), WideTransform{}));
}

glm::dvec3 transformPoint(const RigidTransform& target_from_source, const glm::dvec3& point_in_source) noexcept {
  return target_from_source.rotation * point_in_source + target_from_source.translation;
}

glm::dmat4 toMatrix(const RigidTransform& target_from_source) noexcept {
  glm::dmat4 matrix = glm::mat4_cast(target_from_source.rotation);
  matrix[3] = glm::dvec4(target_from_source.translation, 1.0);
  return matrix;
}

glm::dvec3 rollPitchYaw(const glm::dquat& rotation) noexcept {
  const glm::dmat3 r = glm::mat3_cast(rotation);  // r[column][row]
  const double level = std::hypot(r[0][0], r[0][1]);
  const double pitch = std::atan2(-r[0][2], level);
  if (level < 1e-9) {
    return {0.0, pitch, std::atan2(-r[1][0], r[1][1])};
  }
  return {std::atan2(r[1][2], r[2][2]), pitch, std::atan2(r[0][1], r[0][0])};
}

bool isFinite(const RigidTransform& transform) noexcept {
  return std::isfinite(transform.rotation.w) && std::isfinite(transform.rotation.x) &&
         std::isfinite(transform.rotation.y) && std::isfinite(transform.rotation.z) &&
         std::isfinite(transform.translation.x) && std::isfinite(transform.translation.y) &&
         std::isfinite(transform.translation.z);
}

}  // namespace stillframe::tf
