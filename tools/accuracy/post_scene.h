#pragma once

#include <osg/Group>
#include <osg/ref_ptr>

#include "scenegraph/camera/camera.h"

namespace stillframe::accuracy {

/// A scene with a bit of all that effects work on: a floor, boxes and their corners, thin poles, a cloud of points,
/// lines and a translucent plate, some of it brighter than white. Seeded, the same in every run.
[[nodiscard]] osg::ref_ptr<osg::Group> makePostScene();
/// From where the report looks at it.
[[nodiscard]] scenegraph::CameraView postSceneView();

}  // namespace stillframe::accuracy
