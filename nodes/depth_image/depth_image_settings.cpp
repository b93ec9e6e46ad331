#include "nodes/depth_image/depth_image_settings.h"

#include "nodes/common_specs.h"

namespace stillframe::nodes {

const scenegraph::SettingsTable<DepthImageSettings>& depthImageSettingsTable() {
  using S = DepthImageSettings;
  using scenegraph::SettingKind;
  static const auto kTable =
      scenegraph::SettingsTable<S>{
          {{.key = "color_mode",
            .label = "Colour by",
            .help = "depth, rgb (a colour image of the same frame and size; by depth where there is none), or flat.",
            .kind = SettingKind::Text,
            .choices = {"depth", "rgb", "flat"},
            .choices_only = true},
           &S::color_mode}}
          .with(valueColoringTable("from the nearest to the farthest depth of the topic's first image", " (m)"))
          .with(scenegraph::SettingsTable<S>{
              {{.key = "point_size",
                .label = "Point size (px)",
                .help = "Side of a point; never less than a pixel.",
                .kind = SettingKind::Double,
                .minimum = 0,
                .maximum = 1000},
               &S::point_size},
              {flatColorSpec(), &S::flat_color},
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
               &S::info_topic},
              {{.key = "frame",
                .label = "Frame",
                .help = "Frame that the camera looks from; auto takes the image's, which a DepthImage of a host lacks.",
                .kind = SettingKind::Text,
                .choices = {"auto"}},
               &S::frame}});
  return kTable;
}

}  // namespace stillframe::nodes
