#include "nodes/occupancy_grid/occupancy_grid_settings.h"

#include "nodes/coloring.h"

namespace stillframe::nodes {

const scenegraph::SettingsTable<OccupancyGridSettings>& occupancyGridSettingsTable() {
  using S = OccupancyGridSettings;
  using scenegraph::SettingKind;
  static const scenegraph::SettingsTable<S> kTable{
      {{.key = "color_scheme",
        .label = "Colours",
        .help =
            "map: free white to occupied black; costmap: 0 transparent, blue to red, 99 cyan, 100 magenta; raw: the "
            "byte as grey. In the first two, unknown is grey-green, 101..127 green and below -1 red to yellow.",
        .kind = SettingKind::Text,
        .choices = {"map", "costmap", "raw"},
        .choices_only = true},
       &S::color_scheme},
      {{.key = "alpha",
        .label = "Opacity",
        .help = "1 hides what is below.",
        .kind = SettingKind::Double,
        .minimum = 0,
        .maximum = 1},
       &S::alpha},
      {{.key = "draw_behind",
        .label = "Behind everything",
        .help = "Everything else is drawn over the grid, wherever it is.",
        .kind = SettingKind::Bool},
       &S::draw_behind},
      {legendSpec(), &S::has_legend}};
  return kTable;
}

}  // namespace stillframe::nodes
