#include "nodes/robot_model/robot_model_settings.h"

#include <string_view>
#include <utility>

#include "nodes/common_specs.h"

namespace stillframe::nodes {
namespace {

using scenegraph::SettingKind;
using scenegraph::SettingSpec;

constexpr std::string_view kPrefix = "link.";
constexpr std::string_view kVisible = ".visible";
constexpr std::string_view kOpacity = ".opacity";

std::string keyOf(const std::string& link, std::string_view what) {
  return std::string(kPrefix) + link + std::string(what);
}
SettingSpec visibleSpec(const std::string& link) {
  return {.key = keyOf(link, kVisible),
          .label = link,
          .help = "Whether this link is drawn.",
          .kind = SettingKind::Bool,
          .group = "Links",
          .item = link};
}
SettingSpec linkOpacitySpec(const std::string& link) {
  return {.key = keyOf(link, kOpacity),
          .label = link + ": opacity",
          .help = "1 hides what is behind this link.",
          .kind = SettingKind::Double,
          .minimum = 0,
          .maximum = 1,
          .group = "Links",
          .item = link};
}

}  // namespace

void addLinkSpecs(const std::string& link, std::vector<SettingSpec>& specs) {
  specs.push_back(visibleSpec(link));
  specs.push_back(linkOpacitySpec(link));
}

void addLinkTexts(const std::string& link, const RobotLinkSettings& settings, scenegraph::SettingTexts& texts) {
  texts[keyOf(link, kVisible)] = scenegraph::settingText(settings.is_visible);
  texts[keyOf(link, kOpacity)] = scenegraph::settingText(settings.opacity);
}

std::expected<void, scenegraph::SettingError> takeLinkTexts(scenegraph::SettingTexts& texts,
                                                            RobotModelSettings& settings) {
  auto links = settings.links;
  scenegraph::SettingTexts others;
  for (const auto& [key, text] : texts) {
    const bool is_visible = key.starts_with(kPrefix) && key.ends_with(kVisible);
    const bool is_opacity = key.starts_with(kPrefix) && key.ends_with(kOpacity);
    const std::size_t around = kPrefix.size() + (is_visible ? kVisible.size() : kOpacity.size());
    if ((!is_visible && !is_opacity) || key.size() <= around) {
      others.emplace(key, text);
      continue;
    }
    const std::string link = key.substr(kPrefix.size(), key.size() - around);
    const auto value = scenegraph::parseSetting(is_visible ? visibleSpec(link) : linkOpacitySpec(link), text);
    if (!value) {
      return std::unexpected(value.error());
    }
    RobotLinkSettings& changed = links[link];
    if (is_visible) {
      changed.is_visible = std::get<bool>(*value);
    } else {
      changed.opacity = std::get<double>(*value);
    }
  }
  std::erase_if(links, [](const auto& entry) { return entry.second == RobotLinkSettings{}; });
  settings.links = std::move(links);
  texts = std::move(others);
  return {};
}

const scenegraph::SettingsTable<RobotModelSettings>& robotModelSettingsTable() {
  using S = RobotModelSettings;
  static const scenegraph::SettingsTable<S> kTable{
      {{.key = "visual", .label = "Visual", .help = "The robot as it looks.", .kind = SettingKind::Bool}, &S::visual},
      {{.key = "collision",
        .label = "Collision",
        .help = "The shapes that planners avoid collisions by.",
        .kind = SettingKind::Bool},
       &S::collision},
      {opacitySpec(), &S::opacity},
      {{.key = "joints",
        .label = "Joints",
        .help =
            "auto: links are placed by transforms, and where there are none by the joint states; tf, joint_states: by "
            "these alone; zero: every joint at zero.",
        .kind = SettingKind::Text,
        .choices = {"auto", "tf", "joint_states", "zero"},
        .choices_only = true},
       &S::joints},
      {{.key = "joint_topic",
        .label = "Joint states",
        .help = "Topic of the joint states; auto: the one beside the description, else the first.",
        .kind = SettingKind::Text,
        .choices = {"auto"}},
       &S::joint_topic},
      {{.key = "tf_prefix",
        .label = "Frame prefix",
        .help =
            "Goes before the names of links to make those of frames; a slash is put between, unless it ends in / or _.",
        .kind = SettingKind::Text},
       &S::tf_prefix},
      {{.key = "package_path",
        .label = "Package folders",
        .help = "Folders with the packages of its meshes, separated by colons, looked through before all others.",
        .kind = SettingKind::Text},
       &S::package_path},
      {{.key = "collada_up_axis",
        .label = "Collada up axis",
        .help = "ignored: meshes stand as RViz shows them; file: turned by their <up_axis>, as Foxglove shows them.",
        .kind = SettingKind::Text,
        .choices = {"ignored", "file"},
        .choices_only = true},
       &S::collada_up_axis},
      {{.key = "default_color",
        .label = "Default colour",
        .help = "Colour of what neither the mesh nor the description colours.",
        .kind = SettingKind::Color},
       &S::default_color},
      {{.key = "collision_color",
        .label = "Collision colour",
        .help = "Colour of collision shapes.",
        .kind = SettingKind::Color},
       &S::collision_color}};
  return kTable;
}

}  // namespace stillframe::nodes
