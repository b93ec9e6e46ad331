#include "nodes/coloring.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nodes/points/colormap.h"

namespace stillframe::nodes {

RangeMap ValueColoring::map(const ValueRange& range, double offset) const noexcept {
  const RangeMap map = mapRange(range, offset);
  return reverse_colormap ? RangeMap{-map.scale, 1.0 - map.bias} : map;
}

scenegraph::ColorLegend ValueColoring::legend(std::string title, std::string unit, const ValueRange& range) const {
  const Colormap* const found = findColormap(colormap);
  const Colormap& map = found != nullptr ? *found : colormaps().front();
  scenegraph::ColorLegend legend{
      std::move(title), std::move(unit), range.low, range.high, {map.anchors.begin(), map.anchors.end()}, has_legend};
  if (reverse_colormap) {
    std::ranges::reverse(legend.colors);
  }
  return legend;
}

std::string axisTitle(int axis, const std::string& fixed_frame) {
  return std::string(1, "xyz"[axis]) + (fixed_frame.empty() ? "" : " in " + fixed_frame);
}

scenegraph::SettingSpec legendSpec() {
  return {.key = "legend",
          .label = "Legend",
          .help = "What the colours mean, over the picture.",
          .kind = scenegraph::SettingKind::Bool};
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
            .maximum = 100,
            .not_below = "percentile_low"},
           &S::percentile_high},
          {legendSpec(), &S::has_legend}};
}

ValueRange extentAlong(int axis, const tf::RigidTransform& fixed_from_data, const glm::dvec3& low,
                       const glm::dvec3& high) {
  // The extent of the eight moved corners, without making them.
  const glm::dmat4 matrix = tf::toMatrix(fixed_from_data);
  const double centre = tf::transformPoint(fixed_from_data, low / 2.0 + high / 2.0)[axis];
  double extent = 0.0;
  for (int i = 0; i < 3; ++i) {
    extent += std::abs(matrix[i][axis]) * (high[i] / 2 - low[i] / 2);
  }
  return {centre - extent, centre + extent};
}

glm::dvec4 axisMap(const ValueColoring& coloring, const ValueRange& range, int axis,
                   const tf::RigidTransform& fixed_from_data, const glm::dvec3& origin) {
  // Where the origin lies along the axis is taken off the range in double.
  const RangeMap map = coloring.map(range, tf::transformPoint(fixed_from_data, origin)[axis]);
  const glm::dmat4 matrix = tf::toMatrix(fixed_from_data);
  return {matrix[0][axis] * map.scale, matrix[1][axis] * map.scale, matrix[2][axis] * map.scale, map.bias};
}

void offerFields(scenegraph::SettingSpec& spec, bool has_colors, std::span<const ChannelInfo> fields) {
  if (has_colors) {
    spec.choices.insert(spec.choices.begin() + 1, "rgb");
  }
  for (const ChannelInfo& field : fields) {
    spec.choices.push_back(field.name);
  }
}

std::string fieldNames(bool has_colors, std::span<const ChannelInfo> fields) {
  std::string names = has_colors ? "rgb" : "";
  for (const ChannelInfo& field : fields) {
    names += (names.empty() ? "" : ", ") + field.name;
  }
  return names.empty() ? "none" : names;
}

}  // namespace stillframe::nodes
