#pragma once

#include <cstddef>
#include <expected>

#include "scenegraph/objects/laser_scan.h"
#include "scenegraph/objects/point_cloud.h"
#include "scenegraph/status.h"

namespace stillframe::nodes {

/// A scan as a cloud: x, y, z, range and, where there are as many as ranges, intensity (FLOAT32), and `t`, seconds
/// after the first beam (FLOAT64).
struct ScanCloud {
  scenegraph::PointCloud cloud;
  std::size_t dropped = 0;  ///< beams without a return: not finite, or outside [range_min, range_max]
  double duration_s = 0.0;  ///< from the first to the last beam
};

/// "MalformedScan" where angles, pose or times are not finite, "TooManyBeams" beyond kMaxBeams. A limit of the range
/// that is NaN limits nothing. Any thread.
[[nodiscard]] std::expected<ScanCloud, scenegraph::Status> convertScan(const scenegraph::LaserScan& scan);
inline constexpr std::size_t kMaxBeams = std::size_t{1} << 26;

}  // namespace stillframe::nodes
