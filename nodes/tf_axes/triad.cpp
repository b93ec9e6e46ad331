#include "nodes/tf_axes/triad.h"

#include <array>
#include <cmath>
#include <numbers>
#include <osg/Array>
#include <osg/PrimitiveSet>

#include "generated/stillframe_nodes/shaders.h"
#include "nodes/axis_colors.h"
#include "scenegraph/geometry.h"

namespace stillframe::nodes {
namespace {

constexpr unsigned kSides = 10;

/// Vertices of all arms, as they go to the geometry.
struct Mesh {
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
  osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
  osg::ref_ptr<osg::Vec4ubArray> colors = new osg::Vec4ubArray(osg::Array::BIND_PER_VERTEX);
  osg::ref_ptr<osg::DrawElementsUShort> triangles = new osg::DrawElementsUShort(GL_TRIANGLES);
};

osg::Vec4ub toBytes(const scenegraph::Color& color) {
  const auto byte = [](float value) { return static_cast<unsigned char>(std::lround(255.0F * value)); };
  return {byte(color.r), byte(color.g), byte(color.b), byte(color.a)};
}

/// `axis` 0, 1 or 2; the other two follow cyclically, so that sides keep their winding.
osg::Vec3 alongAxis(unsigned axis, double along, double u, double v) {
  osg::Vec3 point;
  point[static_cast<int>(axis)] = static_cast<float>(along);
  point[static_cast<int>((axis + 1) % 3)] = static_cast<float>(u);
  point[static_cast<int>((axis + 2) % 3)] = static_cast<float>(v);
  return point;
}

void addArm(Mesh& mesh, unsigned axis, double length, double radius, const osg::Vec4ub& color) {
  const auto add = [&](const osg::Vec3& vertex, const osg::Vec3& normal) {
    mesh.vertices->push_back(vertex);
    mesh.normals->push_back(normal);
    mesh.colors->push_back(color);
    return static_cast<GLushort>(mesh.vertices->size() - 1);
  };
  const auto triangle = [&](GLushort a, GLushort b, GLushort c) {
    mesh.triangles->push_back(a);
    mesh.triangles->push_back(b);
    mesh.triangles->push_back(c);
  };
  const auto first = static_cast<GLushort>(mesh.vertices->size());
  for (unsigned i = 0; i <= kSides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSides;
    const double u = std::cos(angle);
    const double v = std::sin(angle);
    const osg::Vec3 normal = alongAxis(axis, 0.0, u, v);
    add(alongAxis(axis, 0.0, radius * u, radius * v), normal);
    add(alongAxis(axis, length, radius * u, radius * v), normal);
  }
  const GLushort tip = add(alongAxis(axis, length, 0.0, 0.0), alongAxis(axis, 1.0, 0.0, 0.0));
  for (unsigned i = 0; i < kSides; ++i) {
    const auto a = static_cast<GLushort>(first + 2 * i);
    const auto b = static_cast<GLushort>(a + 1);
    const auto c = static_cast<GLushort>(a + 2);
    const auto d = static_cast<GLushort>(a + 3);
    triangle(a, c, b);
    triangle(b, c, d);
    triangle(b, d, tip);
  }
}

}  // namespace

osg::ref_ptr<osg::Geometry> makeTriad(double length_m, bool is_dim) {
  Mesh mesh;
  const double radius = length_m / 24.0;
  const std::array<osg::Vec4ub, 3> dim_colors{
      {osg::Vec4ub(112, 76, 76, 255), osg::Vec4ub(76, 104, 80, 255), osg::Vec4ub(78, 86, 116, 255)}};
  for (unsigned axis = 0; axis < 3; ++axis) {
    addArm(mesh, axis, length_m, radius, is_dim ? dim_colors[axis] : toBytes(kAxisColors[axis]));
  }
  osg::ref_ptr<osg::Geometry> triad = scenegraph::makeGeometry();
  triad->setName("triad");
  triad->setVertexArray(mesh.vertices);
  triad->setNormalArray(mesh.normals);
  triad->setColorArray(mesh.colors);
  triad->addPrimitiveSet(mesh.triangles);
  namespace shaders = shaders::stillframe_nodes;
  triad->getOrCreateStateSet()->setAttributeAndModes(
      scenegraph::makeProgram("triad", shaders::k_triad_vert, shaders::k_triad_frag));
  return triad;
}

osg::ref_ptr<osg::Geometry> makeUnitLine() {
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  vertices->push_back({0, 0, 0});
  vertices->push_back({1, 0, 0});
  osg::ref_ptr<osg::Geometry> line = scenegraph::makeGeometry();
  line->setName("parent line");
  line->setVertexArray(vertices);
  line->addPrimitiveSet(new osg::DrawArrays(GL_LINES, 0, 2));
  return line;
}

}  // namespace stillframe::nodes
