#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <osg/Array>
#include <osg/BoundingBox>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/Uniform>
#include <osg/ref_ptr>
#include <string>

#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// Any number of loose triangles in one draw call, each corner in its colour; seen from both sides.
///
/// The origin, in double, is that of the first triangle. Collect with add(), then commit(). GUI thread.
class TriangleDrawable {
 public:
  explicit TriangleDrawable(const std::string& name);
  [[nodiscard]] osg::MatrixTransform& node() const noexcept { return *node_; }

  void clear();
  /// One with a corner that is not finite, or is beyond reach, is left out: false. `is_lit` false: it keeps its
  /// colours.
  bool add(const std::array<glm::dvec3, 3>& corners, const std::array<scenegraph::Color, 3>& colors, bool is_lit);
  void setBlended(bool is_blended);
  void setOpacity(double opacity);
  void commit();

  [[nodiscard]] std::size_t size() const noexcept { return positions_->size() / 3; }
  /// In the frame of the node's parent; invalid without any.
  [[nodiscard]] const osg::BoundingBoxd& box() const noexcept { return box_; }

 private:
  osg::ref_ptr<osg::MatrixTransform> node_;
  osg::ref_ptr<osg::Geometry> geometry_;
  osg::ref_ptr<osg::Vec3Array> positions_;
  osg::ref_ptr<osg::Vec3Array> normals_;
  osg::ref_ptr<osg::Vec4ubArray> colors_;
  osg::ref_ptr<osg::Uniform> opacity_;
  glm::dvec3 origin_{0.0};
  osg::BoundingBoxd box_;
};

/// sRGB bytes; out of range is clamped, NaN is 0.
[[nodiscard]] osg::Vec4ub toBytes(const scenegraph::Color& color);

}  // namespace stillframe::nodes
