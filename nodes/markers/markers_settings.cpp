#include "nodes/markers/markers_settings.h"

#include <array>
#include <cctype>
#include <charconv>
#include <optional>
#include <variant>

#include "nodes/common_specs.h"

namespace stillframe::nodes {
namespace {

using scenegraph::SettingError;
using scenegraph::SettingKind;
using scenegraph::SettingSpec;
using scenegraph::SettingTexts;

constexpr std::string_view kPrefix = "ns_";
constexpr std::size_t kMostSwitches = 200;  // a row each in the window

const scenegraph::SettingsTable<MarkersSettings>& table() {
  using S = MarkersSettings;
  static const scenegraph::SettingsTable<S> kTable{
      {opacitySpec("Multiplies the markers' own."), &S::opacity},
      {{.key = "texts", .label = "Texts", .help = "Draw text markers.", .kind = SettingKind::Bool}, &S::texts}};
  return kTable;
}

bool isPlain(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// The name behind a key; nullopt when it is not written as namespaceKey() does.
std::optional<std::string> namespaceOf(std::string_view key) {
  if (!key.starts_with(kPrefix)) {
    return std::nullopt;
  }
  std::string name;
  for (std::size_t i = kPrefix.size(); i < key.size(); ++i) {
    if (key[i] != '_') {
      name += key[i];
      continue;
    }
    unsigned byte = 0;
    const char* const digits = key.data() + i + 1;
    if (i + 2 >= key.size() || std::from_chars(digits, digits + 2, byte, 16).ptr != digits + 2) {
      return std::nullopt;
    }
    name += static_cast<char>(byte);
    i += 2;
  }
  return namespaceKey(name) == key ? std::optional(name) : std::nullopt;
}

SettingSpec switchOf(const std::string& name) {
  return {.key = namespaceKey(name),
          .label = name.empty() ? "No namespace" : "Namespace " + name,
          .help = "Draw the markers of this namespace.",
          .kind = SettingKind::Bool,
          .group = "Namespaces",
          .item = name.empty() ? "(none)" : name};
}

/// What there are switches for.
std::set<std::string> switched(const MarkersSettings& settings, const std::set<std::string>& namespaces) {
  std::set<std::string> all = settings.hidden_namespaces;
  const bool has_any = namespaces.size() > 1 || (namespaces.size() == 1 && !namespaces.begin()->empty());
  for (const std::string& name : has_any ? namespaces : std::set<std::string>{}) {
    if (all.size() < kMostSwitches + settings.hidden_namespaces.size()) {
      all.insert(name);
    }
  }
  return all;
}

}  // namespace

std::string namespaceKey(std::string_view name) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string key(kPrefix);
  for (const char c : name) {
    if (isPlain(c)) {
      key += c;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      key += '_';
      key += kDigits[byte >> 4U];
      key += kDigits[byte & 15U];
    }
  }
  return key;
}

std::vector<SettingSpec> markersSettingSpecs(const MarkersSettings& settings, const std::set<std::string>& namespaces) {
  std::vector<SettingSpec> specs = table().specs();
  for (const std::string& name : switched(settings, namespaces)) {
    specs.push_back(switchOf(name));
  }
  return specs;
}

SettingTexts markersSettingTexts(const MarkersSettings& settings, const std::set<std::string>& namespaces) {
  SettingTexts texts = table().texts(settings);
  for (const std::string& name : switched(settings, namespaces)) {
    texts[namespaceKey(name)] = scenegraph::settingText(!settings.hidden_namespaces.contains(name));
  }
  return texts;
}

std::expected<void, SettingError> applyMarkersSettings(const SettingTexts& texts, MarkersSettings& settings) {
  MarkersSettings changed = settings;
  SettingTexts others;
  for (const auto& [key, text] : texts) {
    const auto name = namespaceOf(key);
    if (!name) {
      others.emplace(key, text);
      continue;
    }
    const auto value = scenegraph::parseSetting(switchOf(*name), text);
    if (!value) {
      return std::unexpected(value.error());
    }
    if (std::get<bool>(*value)) {
      changed.hidden_namespaces.erase(*name);
    } else {
      changed.hidden_namespaces.insert(*name);
    }
  }
  if (auto applied = table().apply(others, changed); !applied) {
    if (applied.error().code == "UnknownSetting") {
      applied.error().message += ", ns_NAME for a namespace (_2f for '/', and so for all but letters and digits)";
    }
    return applied;
  }
  settings = std::move(changed);
  return {};
}

}  // namespace stillframe::nodes
