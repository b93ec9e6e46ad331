#pragma once

#include <osg/BoundingBox>

#include "scenegraph/camera/box.h"

namespace stillframe::scenegraph {

/// An OSG box for the cameras, which know no OSG.
[[nodiscard]] inline Box toBox(const osg::BoundingBoxd& box) {
  return box.valid() ? Box{{box.xMin(), box.yMin(), box.zMin()}, {box.xMax(), box.yMax(), box.zMax()}} : Box{};
}

}  // namespace stillframe::scenegraph
