#pragma once

#include <osg/Geometry>
#include <osg/StateSet>
#include <osg/ref_ptr>

namespace stillframe::scenegraph {

/// One triangle over the whole target, never culled: what a full-screen step draws, with shaders/full_screen.vert.
[[nodiscard]] osg::ref_ptr<osg::Geometry> makeFullScreenTriangle(const osg::ref_ptr<osg::StateSet>& state);

}  // namespace stillframe::scenegraph
