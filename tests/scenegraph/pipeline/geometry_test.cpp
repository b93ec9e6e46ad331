#include "scenegraph/geometry.h"

#include <gtest/gtest.h>

#include <osg/Group>
#include <osg/observer_ptr>
#include <string>

#include "generated/geometry_test/shaders.h"
#include "scenegraph/known_bound.h"

namespace stillframe::scenegraph {
namespace {

const char* const kVertex = "#version 450 compatibility\nvoid main() { gl_Position = gl_Vertex; }\n";
const char* const kFragment = "#version 450 compatibility\nvoid main() { gl_FragColor = vec4(1); }\n";

TEST(MakeGeometry, UsesVertexBuffersAndNeitherDisplayListsNorVertexArrayObjects) {
  const auto geometry = makeGeometry();
  EXPECT_TRUE(geometry->getUseVertexBufferObjects());
  EXPECT_FALSE(geometry->getUseDisplayList());
  EXPECT_FALSE(geometry->getUseVertexArrayObject());
}

TEST(MakeGeometry, BoundGivenCountsBesidesTheVertices) {
  const auto geometry = makeGeometry({0, 0, 0, 10, 20, 30});
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  vertices->push_back({-1, 5, 5});
  geometry->setVertexArray(vertices);
  geometry->addPrimitiveSet(new osg::DrawArrays{GL_POINTS, 0, 1});
  EXPECT_EQ(geometry->getBoundingBox().xMin(), -1);
  EXPECT_EQ(geometry->getBoundingBox().zMax(), 30);
}

TEST(KnownBound, IsTakenAtItsWordUntilItIsDirtied) {
  const auto geometry = makeGeometry();
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  vertices->push_back({-1, 5, 5});
  geometry->setVertexArray(vertices);
  geometry->addPrimitiveSet(new osg::DrawArrays{GL_POINTS, 0, 1});
  setKnownBound(*geometry, {0, 0, 0, 10, 20, 30});
  osg::ref_ptr<osg::Group> above = new osg::Group;
  above->addChild(geometry);
  EXPECT_EQ(geometry->getBoundingBox().xMin(), 0) << "no vertex was looked at";
  EXPECT_EQ(geometry->getBoundingBox().zMax(), 30);
  EXPECT_EQ(above->getBound().center(), osg::Vec3(5, 10, 15));
  EXPECT_EQ(geometry->getComputeBoundingBoxCallback(), nullptr) << "what a file would keep";
  geometry->dirtyBound();
  EXPECT_EQ(geometry->getBoundingBox().xMin(), -1);
}

TEST(MakeProgram, GivesTheSameObjectForTheSameTextWhileItIsHeld) {
  const auto first = makeProgram("same", kVertex, kFragment);
  EXPECT_EQ(makeProgram("same", kVertex, kFragment), first);
  EXPECT_NE(makeProgram("same", kVertex, std::string(kFragment) + "\n"), first);
  EXPECT_NE(makeProgram("other", kVertex, kFragment), first);
}

TEST(MakeProgram, IsFreedWithItsLastUser) {
  osg::observer_ptr<osg::Program> watch;
  {
    const auto program = makeProgram("freed", kVertex, kFragment);
    watch = program.get();
  }
  EXPECT_FALSE(watch.valid());
  EXPECT_EQ(makeProgram("freed", kVertex, kFragment)->getNumShaders(), 2U);
}

TEST(EmbeddedShaders, CarryTheCommonFunctionsInPlaceOfTheIncludeLine) {
  const std::string text = shaders::geometry_test::k_embedded_vert;
  EXPECT_EQ(text.find("#include"), std::string::npos);
  EXPECT_NE(text.find("uniform float u_linear_output"), std::string::npos);
  EXPECT_NE(text.find("\"quotes\", \\ and ;"), std::string::npos);
  EXPECT_EQ(text.rfind("#version 450 compatibility\n", 0), 0U);
  EXPECT_LT(text.find("vec4 sfOutput"), text.find("void main"));
  EXPECT_NE(std::string(shaders::geometry_test::k_embedded_frag).find("gl_FragColor"), std::string::npos);
}

}  // namespace
}  // namespace stillframe::scenegraph
