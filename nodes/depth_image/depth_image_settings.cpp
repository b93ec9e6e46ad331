#include "nodes/depth_image/depth_image_settings.h"

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

const scenegraph::SettingsTable<DepthImageSettings>& depthImageSettingsTable() {
  using S = DepthImageSettings;
  using scenegraph::SettingKind;
  static const scenegraph::SettingsTable<S> kTable{
      {{.key = "color_mode",
        .label = "Colour by",
        .help = "depth, rgb (a colour image of the same frame and size; by depth where there is none), or flat.",
        .kind = SettingKind::Text,
        .choices = {"depth", "rgb", "flat"},
        .choices_only = true},
       &S::color_mode},
      {{.key = "colormap",
        .label = "Colormap",
        .help = "Colours of the range, near to far.",
        .kind = SettingKind::Text,
        .choices = colormapNames(),
        .choices_only = true},
       &S::colormap},
      {{.key = "reverse_colormap", .label = "Reversed", .help = "Far to near instead.", .kind = SettingKind::Bool},
       &S::reverse_colormap},
      {{.key = "range_mode",
        .label = "Range",
        .help = "auto: from the nearest to the farthest depth of the topic's first image; percentile: the same without "
                "the outermost values; manual: as given.",
        .kind = SettingKind::Text,
        .choices = {"auto", "percentile", "manual"},
        .choices_only = true},
       &S::range_mode},
      {{.key = "range_min",
        .label = "Range from (m)",
        .help = "Depth of the first colour.",
        .kind = SettingKind::Double},
       &S::range_min},
      {{.key = "range_max", .label = "Range to (m)", .help = "Depth of the last colour.", .kind = SettingKind::Double},
       &S::range_max},
      {{.key = "percentile_low",
        .label = "Low percentile (%)",
        .help = "Share of the depths below the first colour.",
        .kind = SettingKind::Double,
        .minimum = 0,
        .maximum = 100},
       &S::percentile_low},
      {{.key = "percentile_high",
        .label = "High percentile (%)",
        .help = "Share of the depths below the last colour.",
        .kind = SettingKind::Double,
        .minimum = 0,
        .maximum = 100},
       &S::percentile_high},
      {{.key = "point_size",
        .label = "Point size (px)",
        .help = "Side of a point; never less than a pixel.",
        .kind = SettingKind::Double,
        .minimum = 0,
        .maximum = 1000},
       &S::point_size},
      {{.key = "flat_color", .label = "Flat colour", .help = "Colour when flat.", .kind = SettingKind::Color},
       &S::flat_color},
      {{.key = "max_depth_m",
        .label = "Farthest (m)",
        .help = "Depths beyond it are not drawn; 0 draws all.",
        .kind = SettingKind::Double,
        .minimum = 0,
        .maximum = 1e6},
       &S::max_depth_m},
      {{.key = "rectify",
        .label = "Rectify",
        .help = "Undo the lens's distortion; off when the images are rectified already.",
        .kind = SettingKind::Bool},
       &S::rectify},
      {{.key = "info_topic",
        .label = "Camera info",
        .help = "Topic of the intrinsics; auto takes the one in the image's frame.",
        .kind = SettingKind::Text,
        .choices = {"auto"}},
       &S::info_topic}};
  return kTable;
}

}  // namespace stillframe::nodes
