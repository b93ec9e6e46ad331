#pragma once

#include "scenegraph/pipeline/offscreen_renderer.h"
#include "scenegraph/scene.h"

namespace stillframe::cli {

/// Draws the legends of what `scene` colours by value over the lower right corner of its picture; nothing where nothing
/// is, or where the picture has no room for one. The larger the picture, the larger they are.
void addLegends(const scenegraph::Scene& scene, scenegraph::Picture& picture);

}  // namespace stillframe::cli
