#pragma once

#include <osg/Array>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/ref_ptr>
#include <string>
#include <vector>

#include "scenegraph/geometry.h"

namespace stillframe::scenegraph {

/// Vertex shader of the test drawables: position from gl_Vertex, colour from gl_Color, points of 5 pixels.
inline const char* const kTestVertex = R"(#version 450 compatibility
out vec4 v_color;
void main() {
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
  gl_PointSize = 5.0;
  v_color = gl_Color;
}
)";

/// Fragment shader as the layers write it: an sRGB colour, linear when the pipeline asks.
inline const char* const kTestFragment = R"(#version 450 compatibility
uniform float u_linear_output = 0.0;
in vec4 v_color;
vec3 linearFromSrgb(vec3 srgb) {
  return mix(pow((srgb + 0.055) / 1.055, vec3(2.4)), srgb / 12.92, lessThanEqual(srgb, vec3(0.04045)));
}
void main() { gl_FragColor = u_linear_output > 0.5 ? vec4(linearFromSrgb(v_color.rgb), v_color.a) : v_color; }
)";

/// A drawable of `vertices` in one sRGB colour, or one for each vertex.
inline osg::ref_ptr<osg::Geode> makeShape(GLenum mode, const std::vector<osg::Vec3>& vertices,
                                          const std::vector<osg::Vec4>& colors) {
  osg::ref_ptr<osg::Geometry> geometry = makeGeometry();
  geometry->setVertexArray(new osg::Vec3Array{vertices.begin(), vertices.end()});
  osg::ref_ptr<osg::Vec4Array> color_array = new osg::Vec4Array{colors.begin(), colors.end()};
  geometry->setColorArray(color_array, colors.size() == 1 ? osg::Array::BIND_OVERALL : osg::Array::BIND_PER_VERTEX);
  geometry->addPrimitiveSet(new osg::DrawArrays{mode, 0, static_cast<GLsizei>(vertices.size())});
  geometry->getOrCreateStateSet()->setAttributeAndModes(makeProgram("test_shape", kTestVertex, kTestFragment));
  geometry->getOrCreateStateSet()->setMode(GL_VERTEX_PROGRAM_POINT_SIZE, osg::StateAttribute::ON);
  osg::ref_ptr<osg::Geode> geode = new osg::Geode;
  geode->addDrawable(geometry);
  return geode;
}

/// A rectangle in the plane z, from (-half_width, -half_height) to (half_width, half_height).
inline osg::ref_ptr<osg::Geode> makeQuad(float half_width, float half_height, float z, const osg::Vec4& color) {
  return makeShape(GL_TRIANGLE_STRIP,
                   {{-half_width, -half_height, z},
                    {half_width, -half_height, z},
                    {-half_width, half_height, z},
                    {half_width, half_height, z}},
                   {color});
}

}  // namespace stillframe::scenegraph
