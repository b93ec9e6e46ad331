#pragma once

#include <QString>
#include <string>

#include "tf/rigid_transform.h"

namespace stillframe::viewer {

/// A pose for people: translation, quaternion (x, y, z, w), and roll, pitch and yaw in degrees, a line each.
[[nodiscard]] QString poseText(const tf::RigidTransform& target_from_source);
/// The same with all 17 digits, as JSON, for the clipboard; angles in radians too.
[[nodiscard]] QString poseJson(const std::string& target, const std::string& source,
                               const tf::RigidTransform& target_from_source);

}  // namespace stillframe::viewer
