#pragma once

#include <span>
#include <vector>

#include "scenegraph/camera/camera.h"
#include "scenegraph/pick/pick_hit.h"
#include "scenegraph/pipeline/id_pass.h"

namespace stillframe::scenegraph {

/// What the samples about a pixel mean, in their order; what is the same thing as the one before is left out. `view`
/// and sizes are those of the picture, the pixel is counted from its top left corner.
[[nodiscard]] std::vector<PickHit> toHits(std::span<const IdSample> samples, std::span<const IdDrawable> drawables,
                                          const CameraView& view, int width_px, int height_px, int x_px, int y_px);

}  // namespace stillframe::scenegraph
