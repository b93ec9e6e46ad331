#pragma once

#include <string>

#include "nodes/points/value_range.h"
#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// How values become colours: the settings of every layer that colours by a value. Settings structs derive from it.
struct ValueColoring {
  std::string colormap = "turbo";
  bool reverse_colormap = false;
  std::string range_mode = "auto";
  double range_min = 0.0;
  double range_max = 1.0;
  double percentile_low = 1.0;
  double percentile_high = 99.0;

  friend bool operator==(const ValueColoring&, const ValueColoring&) = default;

  /// The range that the settings ask for: as given, or what `limits()` or `percentiles(low, high)` say. Only the one
  /// in use is called.
  template <typename Limits, typename Percentiles>
  [[nodiscard]] ValueRange range(const Limits& limits, const Percentiles& percentiles) const {
    return range_mode == "manual"       ? ValueRange{range_min, range_max}
           : range_mode == "percentile" ? percentiles(percentile_low, percentile_high)
                                        : limits();
  }
  /// t of values stored less `offset`, run backwards where the colormap is.
  [[nodiscard]] RangeMap map(const ValueRange& range, double offset = 0.0) const noexcept;
};

/// Rows of ValueColoring, for SettingsTable::with(). `auto_help` says what range "auto" takes; `unit` is " (m)" or "".
[[nodiscard]] scenegraph::SettingsTable<ValueColoring> valueColoringTable(const std::string& auto_help,
                                                                          const std::string& unit = "");

}  // namespace stillframe::nodes
