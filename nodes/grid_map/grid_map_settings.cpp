#include "nodes/grid_map/grid_map_settings.h"

#include "nodes/common_specs.h"

namespace stillframe::nodes {

const scenegraph::SettingsTable<GridMapSettings>& gridMapSettingsTable() {
  using S = GridMapSettings;
  using scenegraph::SettingKind;
  static const auto kTable =
      scenegraph::SettingsTable<S>{
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
           &S::color_field}}
          .with(valueColoringTable("the least and greatest value of the topic's first map"))
          .with(scenegraph::SettingsTable<S>{
              {{.key = "shading",
                .label = "Shaded",
                .help = "Light on the slopes of a surface.",
                .kind = SettingKind::Bool},
               &S::shading},
              {opacitySpec(), &S::opacity},
              {flatColorSpec(), &S::flat_color},
              {missingColorSpec("Colour of a surface's cells whose colour layer is NaN; a flat map has holes there."),
               &S::missing_color}});
  return kTable;
}

}  // namespace stillframe::nodes
