#pragma once

#include <map>
#include <string>

#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// How one link is drawn, apart from the rest.
struct RobotLinkSettings {
  bool is_visible = true;
  double opacity = 1.0;

  friend bool operator==(const RobotLinkSettings&, const RobotLinkSettings&) = default;
};

/// How a robot is drawn.
struct RobotModelSettings {
  bool visual = true;
  bool collision = false;
  double opacity = 1.0;
  std::string joints = "auto";
  std::string joint_topic = "auto";
  std::string tf_prefix;
  std::string package_path;
  std::string collada_up_axis = "ignored";
  scenegraph::Color default_color{.r = 199 / 255.0F, .g = 199 / 255.0F, .b = 199 / 255.0F, .a = 1.0F};
  scenegraph::Color collision_color{.r = 1.0F, .g = 153 / 255.0F, .b = 51 / 255.0F, .a = 153 / 255.0F};
  std::map<std::string, RobotLinkSettings> links;  ///< by name, those that are not as by default

  friend bool operator==(const RobotModelSettings&, const RobotModelSettings&) = default;
};

[[nodiscard]] const scenegraph::SettingsTable<RobotModelSettings>& robotModelSettingsTable();

/// Settings of links have keys like "link.base_link.visible" and "link.base_link.opacity".
/// @{
/// Adds a row for either.
void addLinkSpecs(const std::string& link, std::vector<scenegraph::SettingSpec>& specs);
void addLinkTexts(const std::string& link, const RobotLinkSettings& settings, scenegraph::SettingTexts& texts);
/// Takes those of links out of `texts` into `settings`; on error nothing is changed.
std::expected<void, scenegraph::SettingError> takeLinkTexts(scenegraph::SettingTexts& texts,
                                                            RobotModelSettings& settings);
/// @}

}  // namespace stillframe::nodes
