#include "nodes/primitives/triangle_drawable.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <osg/BufferObject>
#include <osg/PrimitiveSet>

#include "generated/stillframe_nodes/shaders.h"
#include "nodes/osg_math.h"
#include "scenegraph/blending.h"
#include "scenegraph/geometry.h"

namespace stillframe::nodes {
namespace {

constexpr double kReach_m = 1e15;  // as for lines: bounds are computed in float

}  // namespace

osg::Vec4ub toBytes(const scenegraph::Color& color) {
  const auto byte = [](float value) {
    return static_cast<std::uint8_t>(value >= 0.0F ? std::lround(255.0F * std::min(value, 1.0F)) : 0L);
  };
  return {byte(color.r), byte(color.g), byte(color.b), byte(color.a)};
}

TriangleDrawable::TriangleDrawable(const std::string& name)
    : node_(new osg::MatrixTransform),
      geometry_(scenegraph::makeGeometry()),
      positions_(new osg::Vec3Array(osg::Array::BIND_PER_VERTEX)),
      normals_(new osg::Vec3Array(osg::Array::BIND_PER_VERTEX)),
      colors_(new osg::Vec4ubArray(osg::Array::BIND_PER_VERTEX)),
      opacity_(new osg::Uniform("u_opacity", 1.0F)) {
  colors_->setNormalize(true);
  const osg::ref_ptr<osg::VertexBufferObject> buffer = new osg::VertexBufferObject;
  buffer->setUsage(GL_DYNAMIC_DRAW_ARB);
  for (osg::Array* const array : std::initializer_list<osg::Array*>{positions_, normals_, colors_}) {
    array->setVertexBufferObject(buffer);
  }
  geometry_->setName(name);
  namespace shaders = shaders::stillframe_nodes;
  osg::StateSet& state = *geometry_->getOrCreateStateSet();
  state.setAttributeAndModes(scenegraph::makeProgram("surface", shaders::k_surface_vert, shaders::k_surface_frag));
  state.addUniform(opacity_);
  scenegraph::setBlended(state, false);
  node_->setName(name);
  node_->addChild(geometry_);
  commit();
}

void TriangleDrawable::clear() {
  positions_->clear();
  normals_->clear();
  colors_->clear();
  box_.init();
}

bool TriangleDrawable::add(const std::array<glm::dvec3, 3>& corners, const std::array<scenegraph::Color, 3>& colors,
                           bool is_lit) {
  const bool is_sound = std::ranges::all_of(corners, [](const glm::dvec3& corner) {
    return std::abs(corner.x) <= kReach_m && std::abs(corner.y) <= kReach_m && std::abs(corner.z) <= kReach_m;
  });
  if (!is_sound) {
    return false;
  }
  if (positions_->empty()) {
    origin_ = corners[0];
  }
  const glm::dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double area = glm::length(across);
  const bool has_normal = is_lit && area > 0.0 && std::isfinite(area);
  const osg::Vec3 normal = has_normal ? osg::Vec3(toOsg(across / area)) : osg::Vec3();
  for (std::size_t i = 0; i < 3; ++i) {
    positions_->push_back(osg::Vec3(toOsg(corners[i] - origin_)));
    normals_->push_back(normal);
    colors_->push_back(toBytes(colors[i]));
    box_.expandBy(toOsg(corners[i]));
  }
  return true;
}

void TriangleDrawable::setBlended(bool is_blended) {
  scenegraph::setBlended(*geometry_->getOrCreateStateSet(), is_blended);
}

void TriangleDrawable::setOpacity(double opacity) { opacity_->set(static_cast<float>(opacity)); }

void TriangleDrawable::commit() {
  geometry_->removePrimitiveSet(0, geometry_->getNumPrimitiveSets());
  node_->setNodeMask(positions_->empty() ? 0U : ~0U);
  if (positions_->empty()) {
    geometry_->setVertexArray(nullptr);
    geometry_->setNormalArray(nullptr);
    geometry_->setColorArray(nullptr);
    return;
  }
  positions_->dirty();
  normals_->dirty();
  colors_->dirty();
  geometry_->setVertexArray(positions_);
  geometry_->setNormalArray(normals_);
  geometry_->setColorArray(colors_);
  geometry_->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(positions_->size())));
  node_->setMatrix(osg::Matrixd::translate(toOsg(origin_)));
  geometry_->dirtyBound();
}

}  // namespace stillframe::nodes
