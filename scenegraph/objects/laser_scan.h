#pragma once

#include <string>
#include <vector>

#include "scenegraph/objects/object.h"
#include "tf/rigid_transform.h"
#include "tf/time.h"

namespace stillframe::scenegraph {

/// sensor_msgs/LaserScan, foxglove.LaserScan: beam i looks along angle_min + i * angle_increment in the scan's XY plane
/// and was measured i * time_increment after `stamp`.
struct LaserScan {
  static constexpr ObjectType kType = ObjectType::LaserScan;
  tf::TimePoint stamp;
  std::string frame_id;
  tf::RigidTransform pose;  ///< frame_from_scan; identity in ROS
  double angle_min_rad = 0.0;
  double angle_increment_rad = 0.0;
  double time_increment_s = 0.0;  ///< 0: all at once, or not known
  double range_min_m = 0.0;       ///< ranges outside [min, max] and non-finite ones are no returns
  double range_max_m = 0.0;       ///< +infinity where the source has none (Foxglove)
  std::vector<double> ranges_m;
  std::vector<double> intensities;  ///< empty, or one for each range
  [[nodiscard]] std::size_t byteSize() const {
    return sizeof(*this) + (ranges_m.size() + intensities.size()) * sizeof(double);
  }
};

}  // namespace stillframe::scenegraph
