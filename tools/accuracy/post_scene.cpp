#include "tools/accuracy/post_scene.h"

#include <cmath>
#include <osg/Array>
#include <osg/Geometry>
#include <random>
#include <utility>
#include <vector>

#include "generated/stillframe_accuracy_post/shaders.h"
#include "scenegraph/blending.h"
#include "scenegraph/geometry.h"

namespace stillframe::accuracy {
namespace {

constexpr GLenum kProgramPointSize = 0x8642;  // OSG's headers name it only for some profiles
constexpr int kBoxes = 60;
constexpr int kPoles = 30;
constexpr int kPoints = 20'000;

struct Mesh {
  std::vector<osg::Vec3> vertices;
  std::vector<osg::Vec3> normals;
  std::vector<osg::Vec4> colors;

  void add(const osg::Vec3& vertex, const osg::Vec3& normal, const osg::Vec4& color) {
    vertices.push_back(vertex);
    normals.push_back(normal);
    colors.push_back(color);
  }
  /// Six quads, the lower side on the floor.
  void addBox(const osg::Vec3& centre, const osg::Vec3& half, const osg::Vec4& color) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const float side : {-1.0F, 1.0F}) {
        osg::Vec3 normal;
        normal[axis] = side;
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        for (const auto& [a, b] : {std::pair{-1.0F, -1.0F}, {1.0F, -1.0F}, {1.0F, 1.0F}, {-1.0F, 1.0F}}) {
          osg::Vec3 corner = centre;
          corner[axis] += side * half[axis];
          corner[u] += a * half[u];
          corner[v] += b * half[v];
          add(corner, normal, color);
        }
      }
    }
  }
};

osg::ref_ptr<osg::Geometry> makeDrawable(const Mesh& mesh, GLenum mode, bool is_lit, float light) {
  osg::ref_ptr<osg::Geometry> geometry = scenegraph::makeGeometry();
  geometry->setVertexArray(new osg::Vec3Array{mesh.vertices.begin(), mesh.vertices.end()});
  geometry->setNormalArray(new osg::Vec3Array{mesh.normals.begin(), mesh.normals.end()}, osg::Array::BIND_PER_VERTEX);
  geometry->setColorArray(new osg::Vec4Array{mesh.colors.begin(), mesh.colors.end()}, osg::Array::BIND_PER_VERTEX);
  geometry->addPrimitiveSet(new osg::DrawArrays{mode, 0, static_cast<GLsizei>(mesh.vertices.size())});
  osg::StateSet& state = *geometry->getOrCreateStateSet();
  namespace shaders = shaders::stillframe_accuracy_post;
  state.setAttributeAndModes(
      scenegraph::makeProgram("report_surface", shaders::k_surface_vert, shaders::k_surface_frag));
  state.setMode(kProgramPointSize, osg::StateAttribute::ON);
  state.addUniform(new osg::Uniform("u_is_lit", is_lit));
  state.addUniform(new osg::Uniform("u_light", light));
  return geometry;
}

}  // namespace

osg::ref_ptr<osg::Group> makePostScene() {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  const auto color = [&](float alpha) { return osg::Vec4(unit(random), unit(random), unit(random), alpha); };
  const osg::Vec3 up(0, 0, 1);
  Mesh surfaces;
  for (const auto& [x, y] : {std::pair{-12.0F, -12.0F}, {12.0F, -12.0F}, {12.0F, 12.0F}, {-12.0F, 12.0F}}) {
    surfaces.add({x, y, 0}, up, {0.7F, 0.7F, 0.7F, 0.0F});
  }
  for (int i = 0; i < kBoxes; ++i) {
    const osg::Vec3 half(0.1F + 0.6F * unit(random), 0.1F + 0.6F * unit(random), 0.1F + 0.9F * unit(random));
    surfaces.addBox({20.0F * (unit(random) - 0.5F), 20.0F * (unit(random) - 0.5F), half.z()}, half, color(0.0F));
  }
  for (int i = 0; i < kPoles; ++i) {
    const osg::Vec3 half(0.01F, 0.01F, 1.5F);
    surfaces.addBox({20.0F * (unit(random) - 0.5F), 20.0F * (unit(random) - 0.5F), half.z()}, half, color(0.0F));
  }
  Mesh points;
  Mesh lines;
  for (int i = 0; i < kPoints; ++i) {
    // On a ball half out of the floor.
    const float height = 2.0F * unit(random) - 1.0F;
    const float angle = 6.2831853F * unit(random);
    const float across = std::sqrt(1.0F - height * height);
    points.add({2.0F * across * std::cos(angle), 2.0F * across * std::sin(angle), 2.0F * height}, up,
               {0.5F + 0.5F * height, 0.4F, 0.5F - 0.5F * height, 1.0F});
  }
  for (int i = -10; i <= 10; ++i) {
    const auto at = static_cast<float>(i);
    for (const osg::Vec3& end :
         {osg::Vec3(at, -10, 0.01F), osg::Vec3(at, 10, 0.01F), osg::Vec3(-10, at, 0.01F), osg::Vec3(10, at, 0.01F)}) {
      lines.add(end, up, {0.2F, 0.9F, 0.3F, 1.0F});
    }
  }
  Mesh plate;
  plate.addBox({4, 4, 1}, {2, 0.01F, 1}, {0.1F, 0.3F, 1.0F, 0.4F});

  osg::ref_ptr<osg::Group> scene = new osg::Group;
  constexpr float kBright = 1.5F;
  scene->addChild(makeDrawable(surfaces, GL_QUADS, true, kBright));
  scene->addChild(makeDrawable(points, GL_POINTS, false, 1.0F));
  scene->addChild(makeDrawable(lines, GL_LINES, false, 1.0F));
  const osg::ref_ptr<osg::Geometry> translucent = makeDrawable(plate, GL_QUADS, false, 1.0F);
  scenegraph::setBlended(*translucent->getOrCreateStateSet(), true);
  scene->addChild(translucent);
  return scene;
}

scenegraph::CameraView postSceneView() {
  return {.eye_from_fixed = scenegraph::lookAt({9, -11, 6}, {0, 0, 0.5}, {0, 0, 1})};
}

}  // namespace stillframe::accuracy
