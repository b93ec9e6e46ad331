#include "scenegraph/layer_list.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
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

const LayerState* find(const LayerList& list, const std::string& id) {
  const auto found = std::ranges::find(list.layers, id, &LayerState::id);
  return found == list.layers.end() ? nullptr : &*found;
}

std::vector<std::string> idsOf(const LayerList& list) {
  std::vector<std::string> ids;
  std::ranges::transform(list.layers, std::back_inserter(ids), &LayerState::id);
  return ids;
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

namespace {

/// Takes away, adds and sets, but does not arrange.
AppliedLayers applyStates(const LayerList& list, Scene& scene) {
  for (const std::string& topic : list.removed_topics) {
    scene.removeLayer(topic);
  }
  scene.setRemovedTopics(list.removed_topics);
  return applyLayers(list.layers, scene);
}

}  // namespace

AppliedLayers applyLayerList(const LayerList& list, Scene& scene) {
  AppliedLayers applied = applyStates(list, scene);
  scene.arrangeLayers(idsOf(list));
  return applied;
}

AppliedLayers changeLayerList(const LayerList& from, const LayerList& to, Scene& scene) {
  for (const LayerState& state : from.layers) {
    if (find(to, state.id) == nullptr) {
      scene.removeLayer(state.id);
    }
  }
  LayerList changed{{}, to.removed_topics};
  for (const LayerState& state : to.layers) {
    const LayerState* const before = find(from, state.id);
    if (before == nullptr) {
      changed.layers.push_back(state);
    } else if (*before != state) {
      LayerState& change = changed.layers.emplace_back(state);
      std::erase_if(change.settings, [&](const auto& setting) {
        const auto old = before->settings.find(setting.first);
        return old != before->settings.end() && old->second == setting.second;
      });
    }
  }
  AppliedLayers applied = applyStates(changed, scene);
  if (const std::vector<std::string> order = idsOf(to); order != idsOf(from)) {
    scene.arrangeLayers(order);
  }
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
