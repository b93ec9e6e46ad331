#include "scenegraph/pipeline/full_screen.h"

#include "scenegraph/geometry.h"

namespace stillframe::scenegraph {

osg::ref_ptr<osg::Geometry> makeFullScreenTriangle(const osg::ref_ptr<osg::StateSet>& state) {
  osg::ref_ptr<osg::Geometry> triangle = makeGeometry();
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  vertices->push_back({-1.0F, -1.0F, 0.0F});
  vertices->push_back({3.0F, -1.0F, 0.0F});
  vertices->push_back({-1.0F, 3.0F, 0.0F});
  triangle->setVertexArray(vertices);
  triangle->addPrimitiveSet(new osg::DrawArrays{GL_TRIANGLES, 0, 3});
  triangle->setCullingActive(false);
  triangle->setStateSet(state);
  return triangle;
}

}  // namespace stillframe::scenegraph
