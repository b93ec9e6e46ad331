#include "tools/cli/effect_arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>

#include "tools/cli/layer_argument.h"

namespace stillframe::cli {
namespace {

using scenegraph::EffectType;
using scenegraph::SettingTexts;
using scenegraph::ViewEffects;

constexpr std::array<std::string_view, 3> kFlags{"ssao", "edl", "dither"};

/// "Darkens corners; [:radius=,samples=]": all settings but the one that the option's own value is.
std::string helpOf(std::string_view name, std::string_view value_key = {}) {
  const EffectType* const type = scenegraph::findEffectType(name);
  std::string keys;
  for (const auto& spec : type->specs) {
    if (spec.key != value_key) {
      keys += (keys.empty() ? " [:" : ",") + spec.key + "=";
    }
  }
  return std::string(type->label) + ": " + std::string(type->help) + (keys.empty() ? "" : keys + "...]");
}

/// Switches an effect on with the settings behind the first colon of `text`, and those of `more`.
Result<void> switchOn(ViewEffects& effects, const std::string& name, const std::string& option, std::string_view text,
                      SettingTexts more) {
  if (const std::size_t colon = text.find(':'); colon != std::string_view::npos) {
    const auto settings = parseSettings(option + " '" + std::string(text) + "'", text.substr(colon + 1));
    if (!settings) {
      return std::unexpected(settings.error());
    }
    if (scenegraph::findEffectType(name)->specs.empty()) {
      return usageError(option + " has no settings");
    }
    for (const auto& [key, value] : *settings) {
      if (!more.emplace(key, value).second) {
        return usageError(option + " '" + std::string(text) + "' sets '" + key + "' twice");
      }
    }
  }
  if (const auto applied = effects.apply(name, more); !applied) {
    return usageError(option + ": " + applied.error().message);
  }
  effects.setOn(name, true);
  return {};
}

}  // namespace

EffectArguments::EffectArguments(CLI::App& command) {
  for (const std::string_view name : kFlags) {
    command.add_flag("--" + std::string(name), flags_[std::string(name)], helpOf(name));
  }
  command.add_option("--tonemap", tonemap_, helpOf("tonemap", "curve"))->type_name("none|aces|neutral");
  command.add_option("--exposure", exposure_, "Steps of exposure before the tone curve, each doubling the light")
      ->type_name("EV");
  command.add_option("--aa", aa_, helpOf("aa", "mode"))->type_name("none|fxaa|msaa|ssaa");
}

std::vector<std::string> EffectArguments::spelledOut(const std::vector<std::string>& words) {
  std::vector<std::string> spelled = words;
  for (std::string& word : spelled) {
    for (const std::string_view name : kFlags) {
      const std::string head = "--" + std::string(name) + ":";
      if (word.starts_with(head)) {
        word[head.size() - 1] = '=';
        word.insert(head.size(), ":");
      }
    }
  }
  return spelled;
}

Result<ViewEffects> EffectArguments::effects(ViewEffects effects) const {
  for (const auto& [name, typed] : flags_) {
    if (typed.empty()) {
      continue;
    }
    if (typed == "false") {
      effects.setOn(name, false);
      continue;
    }
    if (typed != "true" && !typed.starts_with(':')) {
      return usageError("--" + name + "='" + typed + "': settings are written --" + name + ":key=value,...");
    }
    if (const auto done = switchOn(effects, name, "--" + name, typed, {}); !done) {
      return std::unexpected(done.error());
    }
  }
  const std::string curve = tonemap_.substr(0, tonemap_.find(':'));
  if (!tonemap_.empty() || !exposure_.empty()) {
    SettingTexts settings;
    if (!tonemap_.empty() || !effects.isOn("tonemap")) {
      settings["curve"] = tonemap_.empty() ? "none" : curve;
    }
    if (!exposure_.empty()) {
      settings["exposure"] = exposure_;
    }
    if (const auto done =
            switchOn(effects, "tonemap", tonemap_.empty() ? "--exposure" : "--tonemap", tonemap_, settings);
        !done) {
      return std::unexpected(done.error());
    }
    // Nothing to do is no pass.
    const SettingTexts kept = effects.settings("tonemap");
    effects.setOn("tonemap", kept.at("curve") != "none" || kept.at("exposure") != "0");
  }
  const std::string mode = aa_.substr(0, aa_.find(':'));
  if (aa_ == "none") {
    effects.setOn("aa", false);
  } else if (mode == "none") {
    return usageError("--aa none has no settings");
  } else if (!aa_.empty()) {
    const auto& modes = scenegraph::findEffectType("aa")->specs.front().choices;
    if (std::ranges::find(modes, mode) == modes.end()) {
      return usageError("--aa '" + mode + "' is none of none, fxaa, msaa, ssaa");
    }
    if (const auto done = switchOn(effects, "aa", "--aa", aa_, {{"mode", mode}}); !done) {
      return std::unexpected(done.error());
    }
  }
  return effects;
}

}  // namespace stillframe::cli
