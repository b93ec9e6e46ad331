#pragma once

#include <vector>

#include "scenegraph/camera/camera.h"
#include "scenegraph/pipeline/offscreen_renderer.h"

namespace stillframe::scenegraph {

/// Normals of what is seen in `picture` from `view`, in the fixed frame, 3 a pixel, towards the eye; 0 where nothing
/// was drawn. From depth, as the ambient occlusion has them: exact on planes; a pixel with no plane on any side faces
/// the eye.
[[nodiscard]] std::vector<float> normalsOf(const Picture& picture, const CameraView& view);

}  // namespace stillframe::scenegraph
