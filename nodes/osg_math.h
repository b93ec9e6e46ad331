#pragma once

#include <glm/gtc/type_ptr.hpp>
#include <glm/vec3.hpp>
#include <osg/Matrixd>
#include <osg/Vec3d>
#include <osg/Vec4>

#include "scenegraph/settings.h"
#include "tf/rigid_transform.h"

namespace stillframe::nodes {

/// Exact: both are column vectors in memory order.
[[nodiscard]] inline osg::Matrixd toOsg(const tf::RigidTransform& target_from_source) {
  return osg::Matrixd(glm::value_ptr(tf::toMatrix(target_from_source)));
}
[[nodiscard]] inline osg::Vec3d toOsg(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
[[nodiscard]] inline osg::Vec4 toOsg(const scenegraph::Color& color) { return {color.r, color.g, color.b, color.a}; }

}  // namespace stillframe::nodes
