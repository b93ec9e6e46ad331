#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scenegraph/objects/poses.h"
#include "tests/support/builders.h"

namespace stillframe::test {

/// Poses in `frame`, a second apart when they are a path.
[[nodiscard]] inline scenegraph::PosesInFrame posesOf(scenegraph::PosesKind kind, std::vector<tf::RigidTransform> poses,
                                                      const std::string& frame = "map") {
  scenegraph::PosesInFrame message;
  message.kind = kind;
  message.frame_id = frame;
  message.poses = std::move(poses);
  for (std::size_t i = 0; kind == scenegraph::PosesKind::Path && i < message.poses.size(); ++i) {
    message.stamps.push_back({static_cast<std::int64_t>(i) * 1_s});
  }
  return message;
}

/// The same along points, unturned.
[[nodiscard]] inline scenegraph::PosesInFrame pointsOf(scenegraph::PosesKind kind,
                                                       const std::vector<glm::dvec3>& points) {
  std::vector<tf::RigidTransform> poses;
  for (const glm::dvec3& point : points) {
    poses.push_back({.translation = point});
  }
  return posesOf(kind, std::move(poses));
}

/// A pose with variances x y z rx ry rz.
[[nodiscard]] inline scenegraph::PosesInFrame uncertainPose(const tf::RigidTransform& pose,
                                                            const std::vector<double>& variances) {
  auto message = posesOf(scenegraph::PosesKind::Single, {pose});
  message.covariance.emplace();
  for (std::size_t i = 0; i < variances.size(); ++i) {
    (*message.covariance)[7 * i] = variances[i];
  }
  return message;
}

}  // namespace stillframe::test
