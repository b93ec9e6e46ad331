#include "tools/ingest/converters/host_shapes.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "scenegraph/objects/scene_entities.h"
#include "tf/rigid_transform.h"

namespace stillframe::ingest::converters {

using tf::RigidTransform;

Shape hostVector() {
  Shape shape;
  shape.field<&glm::dvec3::x>("1").field<&glm::dvec3::y>("2").field<&glm::dvec3::z>("3");
  return shape;
}
Shape hostPlanarVector() {
  Shape shape;
  shape.field<&glm::dvec2::x>("1").field<&glm::dvec2::y>("2");
  return shape;
}
Shape hostQuaternion() {
  Shape shape;
  shape.field<&glm::dquat::x>("1").field<&glm::dquat::y>("2").field<&glm::dquat::z>("3").field<&glm::dquat::w>("4");
  return shape;
}
Shape hostPose() {
  Shape shape;
  shape.row<&RigidTransform::translation>("1", hostVector()).row<&RigidTransform::rotation>("2", hostQuaternion());
  return shape;
}
Shape hostColor() {
  using scenegraph::EntityColor;
  Shape shape;
  shape.field<&EntityColor::r>("1").field<&EntityColor::g>("2").field<&EntityColor::b>("3").field<&EntityColor::a>("4");
  return shape;
}

}  // namespace stillframe::ingest::converters
