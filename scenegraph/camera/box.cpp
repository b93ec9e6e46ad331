#include "scenegraph/camera/box.h"

#include <glm/common.hpp>

namespace stillframe::scenegraph {

void Box::add(const glm::dvec3& point) noexcept {
  low = glm::min(low, point);
  high = glm::max(high, point);
}

glm::dvec3 Box::corner(unsigned index) const noexcept {
  return {(index & 1U) != 0 ? high.x : low.x, (index & 2U) != 0 ? high.y : low.y, (index & 4U) != 0 ? high.z : low.z};
}

Box transformBox(const tf::RigidTransform& target_from_source, const Box& box_in_source) noexcept {
  Box box_in_target;
  if (box_in_source.isValid()) {
    for (unsigned i = 0; i < 8; ++i) {
      box_in_target.add(tf::transformPoint(target_from_source, box_in_source.corner(i)));
    }
  }
  return box_in_target;
}

Box atLeast(const Box& box, double radius_m) noexcept {
  if (!box.isValid()) {
    return box;
  }
  Box wide = box;
  wide.add(box.centre() - radius_m);
  wide.add(box.centre() + radius_m);
  return wide;
}

}  // namespace stillframe::scenegraph
