#pragma once

#include <expected>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// How markers are drawn.
struct MarkersSettings {
  double opacity = 1.0;
  bool texts = true;
  std::set<std::string> hidden_namespaces;

  friend bool operator==(const MarkersSettings&, const MarkersSettings&) = default;
};

/// Settings of a topic with these namespaces: the table's, and a switch for each namespace that is there or hidden. Its
/// key is "ns_" and the name, in which each byte but letters and digits is written as "_" and two hexadecimal digits.
[[nodiscard]] std::vector<scenegraph::SettingSpec> markersSettingSpecs(const MarkersSettings& settings,
                                                                       const std::set<std::string>& namespaces);
[[nodiscard]] scenegraph::SettingTexts markersSettingTexts(const MarkersSettings& settings,
                                                           const std::set<std::string>& namespaces);
/// On error nothing is changed. A switch may name a namespace that is not there yet.
std::expected<void, scenegraph::SettingError> applyMarkersSettings(const scenegraph::SettingTexts& texts,
                                                                   MarkersSettings& settings);

/// "ns_..." of a namespace, and back ("" for a text that is no such key's).
[[nodiscard]] std::string namespaceKey(std::string_view name);

}  // namespace stillframe::nodes
