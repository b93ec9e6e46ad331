#include "scenegraph/passes/view_effects.h"

#include <array>

#include "scenegraph/passes/antialiasing.h"
#include "scenegraph/passes/dither.h"
#include "scenegraph/passes/edl.h"
#include "scenegraph/passes/ssao.h"
#include "scenegraph/passes/tone_map.h"

namespace stillframe::scenegraph {

std::span<const EffectType> effectTypes() {
  static const std::array kTypes{
      ssaoEffect(), edlEffect(), toneMapEffect(), antialiasingEffect(), ditherEffect(),
  };
  return kTypes;
}

const EffectType* findEffectType(std::string_view name) {
  for (const EffectType& type : effectTypes()) {
    if (type.name == name) {
      return &type;
    }
  }
  return nullptr;
}

ViewEffects::ViewEffects() {
  for (const EffectType& type : effectTypes()) {
    effects_[std::string(type.name)] = {.is_on = false, .settings = type.defaults};
  }
}

bool ViewEffects::isOn(std::string_view effect) const {
  const auto found = effects_.find(effect);
  return found != effects_.end() && found->second.is_on;
}

void ViewEffects::setOn(std::string_view effect, bool is_on) {
  if (const auto found = effects_.find(effect); found != effects_.end()) {
    found->second.is_on = is_on;
  }
}

SettingTexts ViewEffects::settings(std::string_view effect) const {
  const auto found = effects_.find(effect);
  return found == effects_.end() ? SettingTexts{} : found->second.settings;
}

std::expected<void, SettingError> ViewEffects::apply(std::string_view effect, const SettingTexts& changes) {
  const EffectType* const type = findEffectType(effect);
  if (type == nullptr) {
    std::string known;
    for (const EffectType& there : effectTypes()) {
      known += (known.empty() ? "" : ", ") + std::string(there.name);
    }
    return std::unexpected(SettingError{"UnknownEffect", "no effect '" + std::string(effect) + "'; known: " + known});
  }
  SettingTexts& settings = effects_.find(effect)->second.settings;
  auto changed = type->changed(settings, changes);
  if (!changed) {
    return std::unexpected(changed.error());
  }
  settings = std::move(*changed);
  return {};
}

SettingTexts ViewEffects::toTexts() const {
  SettingTexts texts;
  for (const auto& [name, effect] : effects_) {
    texts[name] = settingText(effect.is_on);
    for (const auto& [key, text] : effect.settings) {
      texts[std::string(name).append(".").append(key)] = text;
    }
  }
  return texts;
}

std::vector<SettingError> ViewEffects::fromTexts(const SettingTexts& texts) {
  std::vector<SettingError> refused;
  for (const auto& [key, text] : texts) {
    const std::size_t dot = key.find('.');
    const std::string effect = key.substr(0, dot);
    if (dot != std::string::npos) {
      if (const auto applied = apply(effect, {{key.substr(dot + 1), text}}); !applied) {
        refused.push_back(applied.error());
      }
      continue;
    }
    const auto is_on = parseSetting({.key = key, .label = {}, .help = {}, .kind = SettingKind::Bool}, text);
    const auto known = apply(effect, {});
    if (!known || !is_on) {
      refused.push_back(known ? is_on.error() : known.error());
    } else {
      setOn(effect, std::get<bool>(*is_on));
    }
  }
  return refused;
}

PostChain ViewEffects::makeChain(bool is_for_display) const {
  PostChain chain;
  for (const EffectType& type : effectTypes()) {
    if (const auto& effect = effects_.find(type.name)->second;
        effect.is_on && (is_for_display || !type.is_for_display)) {
      type.append(effect.settings, chain);
    }
  }
  return chain;
}

PostChain ViewEffects::chain() const { return makeChain(true); }

PostChain ViewEffects::linearChain() const { return makeChain(false); }

}  // namespace stillframe::scenegraph
