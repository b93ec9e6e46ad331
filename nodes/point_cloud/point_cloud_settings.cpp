#include "nodes/point_cloud/point_cloud_settings.h"

#include "nodes/common_specs.h"

namespace stillframe::nodes {

const scenegraph::SettingsTable<PointCloudSettings>& pointCloudSettingsTable() {
  using S = PointCloudSettings;
  using scenegraph::SettingKind;
  static const auto kTable =
      scenegraph::SettingsTable<S>{
          {{.key = "color_field",
            .label = "Colour by",
            .help = "rgb, x, y or z in the fixed frame, flat, or a field; auto takes rgb, else intensity, else z.",
            .kind = SettingKind::Text,
            .choices = {"auto", "x", "y", "z", "flat"}},
           &S::color_field}}
          .with(valueColoringTable("x, y, z by the box of the cloud as it lies now, fields by the least and greatest "
                                   "value of the topic's first cloud"))
          .with(scenegraph::SettingsTable<S>{
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
              {{.key = "round_points",
                .label = "Round",
                .help = "Discs instead of squares.",
                .kind = SettingKind::Bool},
               &S::round_points},
              {opacitySpec(), &S::opacity},
              {flatColorSpec(), &S::flat_color},
              {missingColorSpec("Colour of points whose field is NaN."), &S::missing_color}});
  return kTable;
}

}  // namespace stillframe::nodes
