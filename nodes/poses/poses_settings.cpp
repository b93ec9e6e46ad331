#include "nodes/poses/poses_settings.h"

#include "nodes/common_specs.h"

namespace stillframe::nodes {
namespace {

using S = PosesSettings;
using scenegraph::SettingKind;
using Table = scenegraph::SettingsTable<S>;

Table shapeRows() {
  return {{{.key = "shape",
            .label = "Shape",
            .help = "Drawn at each pose; auto: triads for poses, spheres for points, none along paths and polygons.",
            .kind = SettingKind::Text,
            .choices = {"auto", "triads", "arrows", "spheres", "none"},
            .choices_only = true},
           &S::shape},
          {{.key = "length",
            .label = "Arm length (m)",
            .help = "Length of a triad's arms, of an arrow, and of the orientation cone.",
            .kind = SettingKind::Double,
            .minimum = 1e-4,
            .maximum = 1e6},
           &S::length_m},
          {{.key = "override_color",
            .label = "One arm colour",
            .help = "All arms in the colour below, instead of red, green and blue for x, y and z.",
            .kind = SettingKind::Bool},
           &S::override_color},
          {{.key = "arm_color",
            .label = "Arm colour",
            .help = "Colour of all arms when there is one for all.",
            .kind = SettingKind::Color},
           &S::arm_color},
          {{.key = "radius",
            .label = "Sphere radius (m)",
            .help = "Radius of the spheres.",
            .kind = SettingKind::Double,
            .minimum = 1e-6,
            .maximum = 1e6},
           &S::radius_m},
          {opacitySpec("Of shapes and lines; 1 hides what is behind."), &S::opacity},
          {{.key = "max_shapes",
            .label = "Most shapes",
            .help = "Of more poses than these only every so many has a shape; lines go through all.",
            .kind = SettingKind::Int,
            .minimum = 1,
            .maximum = 1e6},
           &S::max_shapes},
          {{.key = "child_label",
            .label = "Name of the child frame",
            .help = "At the pose of an odometry, the frame that it is of.",
            .kind = SettingKind::Bool},
           &S::child_label}};
}

Table lineRows() {
  return {{{.key = "line",
            .label = "Line",
            .help = "A line through the poses; auto: along paths, trails and round polygons.",
            .kind = SettingKind::Text,
            .choices = {"auto", "on", "off"},
            .choices_only = true},
           &S::line},
          {{.key = "line_width",
            .label = "Line width",
            .help = "In the unit below; never less than a pixel.",
            .kind = SettingKind::Double,
            .minimum = 0,
            .maximum = 1000},
           &S::line_width},
          {{.key = "line_unit",
            .label = "Line width unit",
            .help = "Pixels, or metres.",
            .kind = SettingKind::Text,
            .choices = {"px", "m"},
            .choices_only = true},
           &S::line_unit},
          {{.key = "color_field",
            .label = "Line colour by",
            .help = "flat; time of each pose, in seconds since the first; order; or x, y, z in the data's own frame.",
            .kind = SettingKind::Text,
            .choices = {"flat", "time", "order", "x", "y", "z"},
            .choices_only = true},
           &S::color_field},
          {{.key = "color",
            .label = "Colour",
            .help = "Colour of flat lines, of spheres and of polygons.",
            .kind = SettingKind::Color},
           &S::color},
          {missingColorSpec("Colour of segments whose value is missing."), &S::missing_color},
          {{.key = "fill", .label = "Filled", .help = "Fills polygons.", .kind = SettingKind::Bool}, &S::fill},
          {{.key = "fill_opacity",
            .label = "Fill opacity",
            .help = "Of a filled polygon, within its outline.",
            .kind = SettingKind::Double,
            .minimum = 0,
            .maximum = 1},
           &S::fill_opacity}};
}

Table historyRows() {
  return {{{.key = "trail",
            .label = "Trail",
            .help = "The topic's poses before the one shown, each where it was in its own frame: none, a number of "
                    "poses, those of some seconds, or all.",
            .kind = SettingKind::Text,
            .choices = {"none", "poses", "seconds", "all"},
            .choices_only = true},
           &S::trail},
          {{.key = "trail_poses",
            .label = "Trail poses",
            .help = "How many poses, the one shown among them.",
            .kind = SettingKind::Int,
            .minimum = 1,
            .maximum = 1e6},
           &S::trail_poses},
          {{.key = "trail_seconds",
            .label = "Trail seconds",
            .help = "How long before the pose shown, by log time.",
            .kind = SettingKind::Double,
            .minimum = 0,
            .maximum = 1e9},
           &S::trail_seconds},
          {{.key = "trail_shapes",
            .label = "Trail shapes",
            .help = "A shape at each pose of the trail, not only a line.",
            .kind = SettingKind::Bool},
           &S::trail_shapes},
          {{.key = "covariance",
            .label = "Covariance",
            .help = "An ellipsoid of the position's covariance, about the axes of the pose's frame.",
            .kind = SettingKind::Bool},
           &S::covariance},
          {{.key = "orientation_cone",
            .label = "Orientation cone",
            .help = "With the covariance: a cone about the pose's x axis that its direction varies in.",
            .kind = SettingKind::Bool},
           &S::orientation_cone},
          {{.key = "sigma",
            .label = "Standard deviations",
            .help = "How many the ellipsoid and the cone reach.",
            .kind = SettingKind::Double,
            .minimum = 0.01,
            .maximum = 100},
           &S::sigma},
          {{.key = "covariance_color",
            .label = "Ellipsoid colour",
            .help = "With its opacity.",
            .kind = SettingKind::Color},
           &S::covariance_color},
          {{.key = "cone_color", .label = "Cone colour", .help = "With its opacity.", .kind = SettingKind::Color},
           &S::cone_color}};
}

}  // namespace

const Table& posesSettingsTable() {
  static const Table kTable = shapeRows()
                                  .with(lineRows())
                                  .with(valueColoringTable("the least and greatest value along the line"))
                                  .with(historyRows());
  return kTable;
}

}  // namespace stillframe::nodes
