#include "nodes/voxel_grid/voxel_grid_settings.h"

#include "nodes/common_specs.h"

namespace stillframe::nodes {

const scenegraph::SettingsTable<VoxelGridSettings>& voxelGridSettingsTable() {
  using S = VoxelGridSettings;
  using scenegraph::SettingKind;
  static const auto kTable =
      scenegraph::SettingsTable<S>{
          {{.key = "draw_field",
            .label = "Drawn by",
            .help = "Field that decides which voxels are drawn; auto takes the first. What the colours leave wholly "
                    "transparent is not drawn either.",
            .kind = SettingKind::Text,
            .choices = {"auto"}},
           &S::draw_field},
          {{.key = "draw_if",
            .label = "Drawn if",
            .help = "The value is above 'from', in the range 'from' to 'to', equals 'from', or has any of the bits; "
                    "all draws NaN too.",
            .kind = SettingKind::Text,
            .choices = {"above", "range", "equals", "bits", "all"},
            .choices_only = true},
           &S::draw_if},
          {{.key = "draw_from", .label = "From", .help = "See 'Drawn if'.", .kind = SettingKind::Double},
           &S::draw_from},
          {{.key = "draw_to", .label = "To", .help = "See 'Drawn if'; included.", .kind = SettingKind::Double},
           &S::draw_to},
          {{.key = "draw_bits",
            .label = "Bits",
            .help = "Sum of the bits, any of which the value must have.",
            .kind = SettingKind::Int,
            .minimum = 0,
            .maximum = 4294967295.0},
           &S::draw_bits},
          {{.key = "color_field",
            .label = "Colour by",
            .help = "rgb, x, y or z in the fixed frame, flat, or a field; auto takes rgb, else what decides.",
            .kind = SettingKind::Text,
            .choices = {"auto", "x", "y", "z", "flat"}},
           &S::color_field}}
          .with(valueColoringTable("x, y, z by the box of the grid as it lies now, fields by the least and greatest "
                                   "value of the topic's first grid"))
          .with(scenegraph::SettingsTable<S>{
              {{.key = "shading", .label = "Shaded", .help = "Light on the faces.", .kind = SettingKind::Bool},
               &S::shading},
              {opacitySpec(), &S::opacity},
              {flatColorSpec(), &S::flat_color},
              {missingColorSpec("Colour of voxels whose colour field is NaN."), &S::missing_color}});
  return kTable;
}

}  // namespace stillframe::nodes
