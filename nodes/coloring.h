#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <string_view>

#include "nodes/points/channel.h"
#include "nodes/points/value_range.h"
#include "scenegraph/color_legend.h"
#include "scenegraph/settings.h"
#include "tf/rigid_transform.h"

namespace stillframe::nodes {

/// What values are coloured by at first. Its lightness rises from end to end, also for eyes that lack one sort of
/// cones, and so its order can be seen by anybody, in a grey print too; turbo's colours, brighter to most, come twice
/// for many.
inline constexpr std::string_view kDefaultColormap = "viridis";

/// How values become colours: the settings of every layer that colours by a value. Settings structs derive from it.
struct ValueColoring {
  std::string colormap{kDefaultColormap};
  bool reverse_colormap = false;
  std::string range_mode = "auto";
  double range_min = 0.0;
  double range_max = 1.0;
  double percentile_low = 1.0;
  double percentile_high = 99.0;
  bool has_legend = true;

  friend bool operator==(const ValueColoring&, const ValueColoring&) = default;

  /// The range that the settings ask for: as given, or what `limits()` or `percentiles(low, high)` say. Only the one
  /// in use is called.
  template <typename Limits, typename Percentiles>
  [[nodiscard]] ValueRange range(const Limits& limits, const Percentiles& percentiles) const {
    return range_mode == "manual"       ? ValueRange{range_min, range_max}
           : range_mode == "percentile" ? percentiles(percentile_low, percentile_high)
                                        : limits();
  }
  /// What the colours over `range` mean.
  [[nodiscard]] scenegraph::ColorLegend legend(std::string title, std::string unit, const ValueRange& range) const;
  /// t of values stored less `offset`, run backwards where the colormap is.
  [[nodiscard]] RangeMap map(const ValueRange& range, double offset = 0.0) const noexcept;
};

/// The switch of a layer's legend, which every layer that has one has.
[[nodiscard]] scenegraph::SettingSpec legendSpec();

/// Rows of ValueColoring, for SettingsTable::with(). `auto_help` says what range "auto" takes; `unit` is " (m)" or "".
[[nodiscard]] scenegraph::SettingsTable<ValueColoring> valueColoringTable(const std::string& auto_help,
                                                                          const std::string& unit = "");

/// What a box of the data, low to high, reaches along an axis of the fixed frame.
[[nodiscard]] ValueRange extentAlong(int axis, const tf::RigidTransform& fixed_from_data, const glm::dvec3& low,
                                     const glm::dvec3& high);
/// "z in map": what values along an axis are, in that frame.
[[nodiscard]] std::string axisTitle(int axis, const std::string& fixed_frame);
/// t = dot(xyz, p) + w of points p of the data less `origin`, over a range along that axis; the shader's u_axis.
[[nodiscard]] glm::dvec4 axisMap(const ValueColoring& coloring, const ValueRange& range, int axis,
                                 const tf::RigidTransform& fixed_from_data, const glm::dvec3& origin = glm::dvec3(0.0));

/// Adds rgb, where there are colours, and the fields to the choices of a setting whose first is auto.
void offerFields(scenegraph::SettingSpec& spec, bool has_colors, std::span<const ChannelInfo> fields);
/// "rgb, intensity, ring", or "none".
[[nodiscard]] std::string fieldNames(bool has_colors, std::span<const ChannelInfo> fields);

}  // namespace stillframe::nodes
