#pragma once

#include <expected>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "scenegraph/pipeline/post_chain.h"
#include "scenegraph/settings.h"

namespace stillframe::scenegraph {

/// A kind of effect that a view can switch on: its settings, and how it adds itself to the chain of passes.
///
/// Each is one source of this folder with its shaders, and one line of effectTypes(). Immutable, any thread.
struct EffectType {
  std::string_view name;   ///< snake_case, as in `render --NAME` and layouts
  std::string_view label;  ///< for people
  std::string_view help;   ///< one sentence
  /// Whether it prepares light for a screen: left out of pictures in scene-linear light.
  bool is_for_display = false;
  std::vector<SettingSpec> specs;
  SettingTexts defaults;
  /// `settings` with `changes` made; refuses what does not fit the specs.
  std::function<std::expected<SettingTexts, SettingError>(const SettingTexts& settings, const SettingTexts& changes)>
      changed;
  /// Adds the passes for these settings, which changed() has let through.
  std::function<void(const SettingTexts& settings, PostChain& chain)> append;
};

/// What every effect says of itself.
struct EffectName {
  std::string_view name;
  std::string_view label;
  std::string_view help;
  bool is_for_display = false;
};

/// The type of an effect whose settings are the plain struct `S`.
template <typename S>
[[nodiscard]] EffectType makeEffectType(const EffectName& name, SettingsTable<S> table,
                                        void (*append)(const S& settings, PostChain& chain)) {
  EffectType type{.name = name.name,
                  .label = name.label,
                  .help = name.help,
                  .is_for_display = name.is_for_display,
                  .specs = table.specs(),
                  .defaults = table.texts(S{}),
                  .changed = {},
                  .append = {}};
  type.changed = [table](const SettingTexts& settings,
                         const SettingTexts& changes) -> std::expected<SettingTexts, SettingError> {
    S values;
    for (const SettingTexts& texts : {settings, changes}) {
      if (const auto applied = table.apply(texts, values); !applied) {
        return std::unexpected(applied.error());
      }
    }
    return table.texts(values);
  };
  type.append = [table = std::move(table), append](const SettingTexts& settings, PostChain& chain) {
    S values;
    if (table.apply(settings, values)) {
      append(values, chain);
    }
  };
  return type;
}

/// A state set of these uniforms, for PostPass::parameters.
template <typename... Values>
[[nodiscard]] osg::ref_ptr<osg::StateSet> passParameters(const std::pair<const char*, Values>&... uniforms) {
  osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
  (state->addUniform(new osg::Uniform(uniforms.first, uniforms.second)), ...);
  return state;
}

}  // namespace stillframe::scenegraph
