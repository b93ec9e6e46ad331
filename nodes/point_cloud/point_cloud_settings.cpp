#include "nodes/point_cloud/point_cloud_settings.h"

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

const scenegraph::SettingsTable<PointCloudSettings>& pointCloudSettingsTable() {
  using S = PointCloudSettings;
  using scenegraph::SettingKind;
  static const scenegraph::SettingsTable<S> kTable{
      {{.key = "color_field",
        .label = "Colour by",
        .help = "rgb, x, y or z in the fixed frame, flat, or a field; auto takes rgb, else intensity, else z.",
        .kind = SettingKind::Text,
        .choices = {"auto", "x", "y", "z", "flat"}},
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
        .help = "auto: x, y, z by the box of the cloud as it lies now, fields by the least and greatest value of the "
                "topic's first cloud; percentile: the same without the outermost values; manual: as given.",
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
      {{.key = "point_size",
        .label = "Point size",
        .help = "Side of a point in the unit below; never less than a pixel.",
        .kind = SettingKind::Double,
        .minimum = 0,
        .maximum = 1000},
       &S::point_size},
      {{.key = "size_unit",
        .label = "Size unit",
        .help = "Pixels, or metres.",
        .kind = SettingKind::Text,
        .choices = {"px", "m"},
        .choices_only = true},
       &S::size_unit},
      {{.key = "round_points", .label = "Round", .help = "Discs instead of squares.", .kind = SettingKind::Bool},
       &S::round_points},
      {{.key = "opacity",
        .label = "Opacity",
        .help = "1 hides what is behind.",
        .kind = SettingKind::Double,
        .minimum = 0,
        .maximum = 1},
       &S::opacity},
      {{.key = "flat_color", .label = "Flat colour", .help = "Colour when flat.", .kind = SettingKind::Color},
       &S::flat_color},
      {{.key = "missing_color",
        .label = "NaN colour",
        .help = "Colour of points whose field is NaN.",
        .kind = SettingKind::Color},
       &S::missing_color}};
  return kTable;
}

}  // namespace stillframe::nodes
