#pragma once

#include <expected>

#include "scenegraph/pipeline/offscreen_renderer.h"
#include "tools/cli/scene_session.h"

namespace stillframe::cli {

/// Fills in which layer is seen at each pixel of `picture`: that one whose depth, drawn alone, is nearest to that of
/// all. Draws the scene once more for each visible layer, without effects; whatever shaders the layers have, they need
/// not know of it. Of layers with the very same depth the first counts.
std::expected<void, scenegraph::Status> addLayerIds(scenegraph::OffscreenRenderer& renderer, SceneSession& session,
                                                    const scenegraph::CameraView& view,
                                                    const scenegraph::RenderOptions& options,
                                                    scenegraph::Picture& picture);

}  // namespace stillframe::cli
