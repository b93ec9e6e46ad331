#pragma once

#include <osg/BoundingBox>
#include <osg/Geometry>

namespace stillframe::scenegraph {

/// Makes `bound` what a geometry of millions of vertices says its bound is, until it is dirtied again: OSG would go
/// through every index for it in the first frame, 30 ns each. Leaves nothing behind that a file would keep. GUI thread.
void setKnownBound(osg::Geometry& geometry, const osg::BoundingBox& bound);

}  // namespace stillframe::scenegraph
