#pragma once

#include <expected>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/passes/effect.h"

namespace stillframe::scenegraph {

/// Every kind of effect, in the order in which their passes run: occlusion, eye-dome lighting, tone mapping,
/// anti-aliasing, dithering.
[[nodiscard]] std::span<const EffectType> effectTypes();
/// By name; nullptr when there is none of that name.
[[nodiscard]] const EffectType* findEffectType(std::string_view name);

/// Which effects a view has on, and their settings: a plain value, compared, copied, saved as texts. All are off at
/// first; one that is off keeps its settings and adds nothing to the chain. Any thread, one at a time.
class ViewEffects {
 public:
  ViewEffects();

  [[nodiscard]] bool isOn(std::string_view effect) const;
  /// Does nothing for a name that there is not.
  void setOn(std::string_view effect, bool is_on);
  [[nodiscard]] SettingTexts settings(std::string_view effect) const;
  /// Changes some settings of one effect, on or off; on error none. Code "UnknownEffect" names those there are.
  std::expected<void, SettingError> apply(std::string_view effect, const SettingTexts& changes);

  /// All of it for layouts: "ssao" is "true" or "false", "ssao.radius" its radius.
  [[nodiscard]] SettingTexts toTexts() const;
  /// Takes over what toTexts() gave. What is not understood is left out, each with its reason; the rest counts.
  std::vector<SettingError> fromTexts(const SettingTexts& texts);

  /// The passes of what is on. Scene-linear: without what prepares light for a screen.
  [[nodiscard]] PostChain chain() const;
  [[nodiscard]] PostChain linearChain() const;

  friend bool operator==(const ViewEffects&, const ViewEffects&) = default;

 private:
  struct Effect {
    bool is_on = false;
    SettingTexts settings;
    friend bool operator==(const Effect&, const Effect&) = default;
  };
  [[nodiscard]] PostChain makeChain(bool is_for_display) const;

  std::map<std::string, Effect, std::less<>> effects_;  // all types, by name
};

}  // namespace stillframe::scenegraph
