#pragma once

#include <expected>
#include <vector>

#include "scenegraph/layer_state.h"
#include "scenegraph/scene.h"
#include "scenegraph/settings.h"
#include "scenegraph/status.h"

namespace stillframe::scenegraph {

[[nodiscard]] LayerState layerState(const LayerSlot& slot);
[[nodiscard]] LayerList layerList(const Scene& scene);

/// Brings the layers of `scene` to `list`, adding and removing what it says; layers that it does not name stay as they
/// are, behind the others. Applies what can be applied, and returns a sentence for each thing that cannot.
std::vector<Status> applyLayerList(const LayerList& list, Scene& scene);

/// Settings of a layer, with "visible" and "title" among them, which all layers have. On error nothing is changed.
std::expected<void, SettingError> applyLayerSettings(SettingTexts settings, LayerSlot& slot);

}  // namespace stillframe::scenegraph
