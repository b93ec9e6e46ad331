#include "scenegraph/layer_list.h"

#include <optional>
#include <utility>
#include <variant>

namespace stillframe::scenegraph {
namespace {

/// All settings at once, or one by one where some are refused.
void applySettings(const LayerState& state, Layer& layer, std::vector<Status>& refused) {
  if (state.settings.empty() || layer.applySettings(state.settings)) {
    return;
  }
  for (const auto& [key, text] : state.settings) {
    if (const auto applied = layer.applySettings({{key, text}}); !applied) {
      refused.push_back({StatusLevel::Warn, applied.error().code, "'" + state.id + "': " + applied.error().message});
    }
  }
}

}  // namespace

LayerState layerState(const LayerSlot& slot) {
  return {slot.id, slot.title == slot.id ? "" : slot.title, slot.layer->isVisible(), slot.layer->settings()};
}

LayerList layerList(const Scene& scene) {
  LayerList list{{}, scene.removedTopics()};
  for (const auto& slot : scene.layers()) {
    list.layers.push_back(layerState(*slot));
  }
  return list;
}

std::vector<Status> applyLayerList(const LayerList& list, Scene& scene) {
  std::vector<Status> refused;
  for (const std::string& topic : list.removed_topics) {
    scene.removeLayer(topic);
  }
  scene.setRemovedTopics(list.removed_topics);
  std::vector<std::string> order;
  for (const LayerState& state : list.layers) {
    const auto slot = scene.addLayer(state.id);
    if (!slot) {
      refused.push_back(slot.error());
      continue;
    }
    order.push_back(state.id);
    (*slot)->title = state.title.empty() ? state.id : state.title;
    (*slot)->layer->setVisible(state.is_visible);
    applySettings(state, *(*slot)->layer, refused);
  }
  scene.arrangeLayers(order);
  return refused;
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
