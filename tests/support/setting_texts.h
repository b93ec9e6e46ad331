#pragma once

#include <string>
#include <vector>

#include "scenegraph/settings.h"

namespace stillframe::test {

/// Points that a pixel in their middle tells apart.
inline const scenegraph::SettingTexts kBig = {{"point_size", "9"}};

/// `settings` and those of `more` that they do not have.
inline scenegraph::SettingTexts with(scenegraph::SettingTexts settings, const scenegraph::SettingTexts& more) {
  settings.insert(more.begin(), more.end());
  return settings;
}

/// Texts that `spec` must take.
inline std::vector<std::string> goodTexts(const scenegraph::SettingSpec& spec) {
  std::vector<std::string> texts = spec.choices;
  const bool is_bounded = spec.minimum < spec.maximum;
  switch (spec.kind) {
    case scenegraph::SettingKind::Bool:
      return {"true", "false"};
    case scenegraph::SettingKind::Int:
      texts = is_bounded ? std::vector<std::string>{scenegraph::settingText(static_cast<std::int64_t>(spec.minimum)),
                                                    scenegraph::settingText(static_cast<std::int64_t>(spec.maximum))}
                         : std::vector<std::string>{"0", "7"};
      break;
    case scenegraph::SettingKind::Double:
      texts = is_bounded ? std::vector<std::string>{scenegraph::settingText(spec.minimum),
                                                    scenegraph::settingText(spec.maximum)}
                         : std::vector<std::string>{"0.10000000000000001", "-1e-300"};
      break;
    case scenegraph::SettingKind::Text:
      break;
    case scenegraph::SettingKind::Color:
      return {"#000000", "#ffffff", "#12345678"};
  }
  return texts;
}

/// The other end of a pair of settings, where neither value of `spec` passes it.
inline scenegraph::SettingTexts outOfTheWay(const scenegraph::SettingSpec& spec,
                                            const std::vector<scenegraph::SettingSpec>& specs) {
  scenegraph::SettingTexts texts;
  for (const scenegraph::SettingSpec& other : specs) {
    if (other.not_below == spec.key) {
      texts[other.key] = scenegraph::settingText(other.maximum);
    } else if (spec.not_below == other.key) {
      texts[other.key] = scenegraph::settingText(other.minimum);
    }
  }
  return texts;
}

/// Texts that `spec` must refuse.
inline std::vector<std::string> badTexts(const scenegraph::SettingSpec& spec) {
  std::vector<std::string> texts;
  switch (spec.kind) {
    case scenegraph::SettingKind::Bool:
      return {"maybe", ""};
    case scenegraph::SettingKind::Int:
      texts = {"1.5", "x", "", "99999999999999999999"};
      break;
    case scenegraph::SettingKind::Double:
      texts = {"nan", "inf", "1.0.0", "", "1e999"};
      break;
    case scenegraph::SettingKind::Text:
      return spec.choices_only ? std::vector<std::string>{"no such choice"} : std::vector<std::string>{};
    case scenegraph::SettingKind::Color:
      return {"red", "#12345", "#gg0000", ""};
  }
  if (spec.minimum < spec.maximum) {
    texts.push_back(scenegraph::settingText(spec.maximum * 2 + 1e6));
  }
  return texts;
}

}  // namespace stillframe::test
