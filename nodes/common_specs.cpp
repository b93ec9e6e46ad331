#include "nodes/common_specs.h"

namespace stillframe::nodes {

using scenegraph::SettingKind;
using scenegraph::SettingSpec;

SettingSpec opacitySpec(const std::string& help) {
  return {.key = "opacity", .label = "Opacity", .help = help, .kind = SettingKind::Double, .minimum = 0, .maximum = 1};
}

SettingSpec flatColorSpec() {
  return {.key = "flat_color", .label = "Flat colour", .help = "Colour when flat.", .kind = SettingKind::Color};
}

SettingSpec missingColorSpec(const std::string& help) {
  return {.key = "missing_color", .label = "NaN colour", .help = help, .kind = SettingKind::Color};
}

}  // namespace stillframe::nodes
