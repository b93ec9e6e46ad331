#include "nodes/grid_map/grid_map_settings.h"

#include "nodes/points/colormap.h"

namespace stillframe::nodes {
namespace {

std::vector<std::string> colormapNames() {
  std::vector<std::string> names;
  for (const Colormap& map : colormaps()) {
    names.emplace_back(map.name);
  }
  return names;
}

}  // namespace

const scenegraph::SettingsTable<GridMapSettings>& gridMapSettingsTable() {
  using S = GridMapSettings;
  using scenegraph::SettingKind;
  static const scenegraph::SettingsTable<S> kTable{
      {{.key = "height_field",
        .label = "Height",
        .help = "Layer that is the height in metres; auto takes elevation, and lies flat where there is none.",
        .kind = SettingKind::Text,
        .choices = {"auto"}},
       &S::height_field},
      {{.key = "flat",
        .label = "Flat",
        .help = "A level picture of the cells instead of a surface through their centres.",
        .kind = SettingKind::Bool},
       &S::flat},
      {{.key = "color_field",
        .label = "Colour by",
        .help = "rgb, flat, or a layer; auto takes rgb, else the height, else the first layer.",
        .kind = SettingKind::Text,
        .choices = {"auto", "flat"}},
       &S::color_field},
      {{.key = "colormap",
        .label = "Colormap",
        .help = "Colours of the range, low to high.",
        .kind = SettingKind::Text,
        .choices = colormapNames(),
        .choices_only = true},
       &S::colormap},
      {{.key = "reverse_colormap", .label = "Reversed", .help = "High to low instead.", .kind = SettingKind::Bool},
       &S::reverse_colormap},
      {{.key = "range_mode",
        .label = "Range",
        .help = "auto: the least and greatest value of the topic's first map; percentile: the same without the "
                "outermost values; manual: as given.",
        .kind = SettingKind::Text,
        .choices = {"auto", "percentile", "manual"},
        .choices_only = true},
       &S::range_mode},
      {{.key = "range_min", .label = "Range from", .help = "Value of the first colour.", .kind = SettingKind::Double},
       &S::range_min},
      {{.key = "range_max", .label = "Range to", .help = "Value of the last colour.", .kind = SettingKind::Double},
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
       &S::percentile_high},
      {{.key = "shading", .label = "Shaded", .help = "Light on the slopes of a surface.", .kind = SettingKind::Bool},
       &S::shading},
      {{.key = "opacity",
        .label = "Opacity",
        .help = "1 hides what is behind.",
        .kind = SettingKind::Double,
        .minimum = 0,
        .maximum = 1},
       &S::opacity},
      {{.key = "flat_color", .label = "One colour", .help = "Colour when coloured flat.", .kind = SettingKind::Color},
       &S::flat_color},
      {{.key = "missing_color",
        .label = "NaN colour",
        .help = "Colour of a surface's cells whose colour layer is NaN; a flat map has holes there.",
        .kind = SettingKind::Color},
       &S::missing_color}};
  return kTable;
}

}  // namespace stillframe::nodes
