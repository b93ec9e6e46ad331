#pragma once

#include <expected>
#include <span>
#include <vector>

#include "scenegraph/layer_state.h"
#include "scenegraph/scene.h"
#include "scenegraph/settings.h"
#include "scenegraph/status.h"

namespace stillframe::scenegraph {

[[nodiscard]] LayerState layerState(const LayerSlot& slot);
/// The layers as they are, and behind them what waits.
[[nodiscard]] LayerList layerList(const Scene& scene, std::span<const LayerState> waiting = {});

/// What became of saved layers in a scene.
struct AppliedLayers {
  std::vector<Status> refused;      ///< settings that their layers did not take
  std::vector<Status> absent;       ///< layers that cannot be added
  std::vector<LayerState> waiting;  ///< both, to be tried again when the dataset has grown, and to be saved again
};

/// Adds, names, shows and sets these layers. One whose topic does not exist (yet) waits; a setting that is refused
/// costs only itself.
[[nodiscard]] AppliedLayers applyLayers(std::span<const LayerState> layers, Scene& scene);
/// Brings the layers of `scene` to `list`, adding and removing what it says; layers that it does not name stay as they
/// are, behind the others.
[[nodiscard]] AppliedLayers applyLayerList(const LayerList& list, Scene& scene);

/// Brings the layers of `scene` from `from` to `to`, touching only what differs between these two: what else has
/// changed in the scene meanwhile stays. Returns what applyLayerList() does.
[[nodiscard]] AppliedLayers changeLayerList(const LayerList& from, const LayerList& to, Scene& scene);

/// Settings of a layer, with "visible" and "title" among them, which all layers have. On error nothing is changed.
std::expected<void, SettingError> applyLayerSettings(SettingTexts settings, LayerSlot& slot);

}  // namespace stillframe::scenegraph
