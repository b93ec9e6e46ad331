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

bool isFinite(const RigidTransform& transform) noexcept {
  return std::isfinite(transform.rotation.w) && std::isfinite(transform.rotation.x) &&
         std::isfinite(transform.rotation.y) && std::isfinite(transform.rotation.z) &&
         std::isfinite(transform.translation.x) && std::isfinite(transform.translation.y) &&
         std::isfinite(transform.translation.z);
}

}  // namespace stillframe::tf
