#include "nodes/coloring.h"

#include "nodes/points/colormap.h"

namespace stillframe::nodes {

RangeMap ValueColoring::map(const ValueRange& range, double offset) const noexcept {
  const RangeMap map = mapRange(range, offset);
  return reverse_colormap ? RangeMap{-map.scale, 1.0 - map.bias} : map;
}

scenegraph::SettingsTable<ValueColoring> valueColoringTable(const std::string& auto_help, const std::string& unit) {
  using S = ValueColoring;
  using scenegraph::SettingKind;
  std::vector<std::string> colormap_names;
  for (const Colormap& map : colormaps()) {
    colormap_names.emplace_back(map.name);
  }
  return {{{.key = "colormap",
            .label = "Colormap",
            .help = "Colours of the range, low to high.",
            .kind = SettingKind::Text,
            .choices = std::move(colormap_names),
            .choices_only = true},
           &S::colormap},
          {{.key = "reverse_colormap", .label = "Reversed", .help = "High to low instead.", .kind = SettingKind::Bool},
           &S::reverse_colormap},
          {{.key = "range_mode",
            .label = "Range",
            .help = "auto: " + auto_help + "; percentile: the same without the outermost values; manual: as given.",
            .kind = SettingKind::Text,
            .choices = {"auto", "percentile", "manual"},
            .choices_only = true},
           &S::range_mode},
          {{.key = "range_min",
            .label = "Range from" + unit,
            .help = "Value of the first colour.",
            .kind = SettingKind::Double},
           &S::range_min},
          {{.key = "range_max",
            .label = "Range to" + unit,
            .help = "Value of the last colour.",
            .kind = SettingKind::Double},
           &S::range_max},
          {{.key = "percentile_low",
            .label = "Low percentile (%)",
            .help = "Share of the values below the first colour.",
            .kind = SettingKind::Double,
            .minimum = 0,
            .maximum = 100},
           &S::percentile_low},
          {{.key = "percentile_high",
            .label = "High percentile (%)",
            .help = "Share of the values below the last colour.",
            .kind = SettingKind::Double,
            .minimum = 0,
            .maximum = 100},
           &S::percentile_high}};
}

}  // namespace stillframe::nodes
