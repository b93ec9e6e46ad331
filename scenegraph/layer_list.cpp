#include "scenegraph/layer_list.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>
#include <variant>

namespace stillframe::scenegraph {
namespace {

/// All settings at once, or one by one where some are refused; those come back.
SettingTexts applySettings(const LayerState& state, Layer& layer, std::vector<Status>& refused) {
  if (state.settings.empty() || layer.applySettings(state.settings)) {
    return {};
  }
  SettingTexts left;
  for (const auto& [key, text] : state.settings) {
    if (const auto applied = layer.applySettings({{key, text}}); !applied) {
      refused.push_back({StatusLevel::Warn, applied.error().code, "'" + state.id + "': " + applied.error().message});
      left[key] = text;
    }
  }
  return left;
}

}  // namespace

LayerState layerState(const LayerSlot& slot) {
  return {slot.id, slot.title == slot.id ? "" : slot.title, slot.layer->isVisible(), slot.layer->settings()};
}

LayerList layerList(const Scene& scene, std::span<const LayerState> waiting) {
  LayerList list{{}, scene.removedTopics()};
  for (const auto& slot : scene.layers()) {
    list.layers.push_back(layerState(*slot));
  }
  for (const LayerState& state : waiting) {
    const auto same = std::ranges::find(list.layers, state.id, &LayerState::id);
    if (same == list.layers.end()) {
      list.layers.push_back(state);
    } else {
      same->settings.insert(state.settings.begin(), state.settings.end());  // what the layer knows stays
    }
  }
  return list;
}

AppliedLayers applyLayers(std::span<const LayerState> layers, Scene& scene) {
  AppliedLayers applied;
  for (const LayerState& state : layers) {
    const auto slot = scene.addLayer(state.id);
    if (!slot) {
      applied.absent.push_back(slot.error());
      applied.waiting.push_back(state);
      continue;
    }
    (*slot)->title = state.title.empty() ? state.id : state.title;
    (*slot)->layer->setVisible(state.is_visible);
    if (SettingTexts left = applySettings(state, *(*slot)->layer, applied.refused); !left.empty()) {
      applied.waiting.push_back(state);
      applied.waiting.back().settings = std::move(left);
    }
  }
  return applied;
}

AppliedLayers applyLayerList(const LayerList& list, Scene& scene) {
  for (const std::string& topic : list.removed_topics) {
    scene.removeLayer(topic);
  }
  scene.setRemovedTopics(list.removed_topics);
  AppliedLayers applied = applyLayers(list.layers, scene);
  std::vector<std::string> order;
  std::ranges::transform(list.layers, std::back_inserter(order), &LayerState::id);
  scene.arrangeLayers(order);
  return applied;
}

std::expected<void, SettingError> applyLayerSettings(SettingTexts settings, LayerSlot& slot) {
  std::optional<bool> visible;
  if (const auto text = settings.find("visible"); text != settings.end()) {
    const auto value =
        parseSetting({.key = "visible", .label = "Visible", .help = "", .kind = SettingKind::Bool}, text->second);
    if (!value) {
      return std::unexpected(value.error());
    }
    visible = std::get<bool>(*value);
    settings.erase(text);
  }
  std::string title = slot.title;
  if (const auto text = settings.find("title"); text != settings.end()) {
    title = text->second.empty() ? slot.id : text->second;
    settings.erase(text);
  }
  if (!settings.empty()) {
    if (const auto applied = slot.layer->applySettings(settings); !applied) {
      return applied;
    }
  }
  slot.title = std::move(title);
  slot.layer->setVisible(visible.value_or(slot.layer->isVisible()));
  return {};
}

}  // namespace stillframe::scenegraph
