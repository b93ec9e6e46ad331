#pragma once

#include <cstdint>
#include <string>

#include "nodes/point_cloud/cloud_points.h"
#include "nodes/point_cloud/point_cloud_settings.h"
#include "nodes/points/value_range.h"
#include "tf/rigid_transform.h"

namespace stillframe::nodes {

/// What the points take their colour from; the numbers are the shader's.
enum class ColorMode : std::uint8_t { Flat = 0, Rgb = 1, Value = 2, Axis = 3 };

struct ColorChoice {
  ColorMode mode = ColorMode::Flat;
  int axis = 2;             ///< Axis: 0, 1, 2 of the fixed frame
  std::string channel;      ///< Value
  bool is_missing = false;  ///< the cloud does not have what the settings name: Flat instead

  friend bool operator==(const ColorChoice&, const ColorChoice&) = default;
};

/// What `color_field` means for `cloud`. "auto" goes by `reference`, the first cloud of the topic, so that it does not
/// change under way; where `cloud` lacks that, by `cloud`.
[[nodiscard]] ColorChoice chooseColor(const std::string& color_field, const CloudPoints& reference,
                                      const CloudPoints& cloud);

/// The channel that colours by these settings will come from, for CloudPoints::make().
[[nodiscard]] CloudPoints::WantedChannel wantedChannel(const PointCloudSettings& settings);

/// Makes what colours of that choice, in the range that the settings ask for, need of `cloud`: the rest is then quick,
/// but for what moves. Milliseconds per million points the first time; any thread.
void prepareColors(const CloudPoints& cloud, const ColorChoice& choice, const PointCloudSettings& settings);
[[nodiscard]] bool areColorsPrepared(const CloudPoints& cloud, const ColorChoice& choice,
                                     const PointCloudSettings& settings);

/// Range of a field, held across time: of `reference` where it has the field, else of `cloud`.
[[nodiscard]] ValueRange channelRange(const PointCloudSettings& settings, const std::string& channel,
                                      const CloudPoints& reference, const CloudPoints& cloud);
/// Range of an axis of the fixed frame: the cloud's source box (or its percentiles) moved to where it is now.
[[nodiscard]] ValueRange axisRange(const PointCloudSettings& settings, int axis, const CloudPoints& cloud,
                                   const tf::RigidTransform& fixed_from_points);

}  // namespace stillframe::nodes
