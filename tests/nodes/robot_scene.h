#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "tests/nodes/poses/poses_builder.h"
#include "tests/support/builders.h"

namespace stillframe::test {

/// A wavy surface of 60 x 40 points with intensity and packed colours, frames of a small robot, and poses of every kind
/// in `map`, which lies at `utm_from_map` in the frame "utm". For more topics.
inline DatasetBuilder robotBuilderAt(const glm::dvec3& utm_from_map) {
  CloudBuilder cloud("lidar");
  cloud.xyz().field("intensity", scenegraph::FieldType::Float32).field("rgb", scenegraph::FieldType::Float32);
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < 60; ++column) {
      const double x = 0.1 * column - 3.0;
      const double y = 0.1 * row - 2.0;
      const auto red = static_cast<std::uint32_t>(column * 4);
      const auto green = static_cast<std::uint32_t>(row * 6);
      const std::uint32_t word = red << 16U | green << 8U | (255U - red);
      cloud.point({x, y, 0.4 * std::sin(2.0 * x) * std::cos(1.5 * y), 17.0 * x * y,
                   static_cast<double>(std::bit_cast<float>(word))});
    }
  }
  std::vector<tf::RigidTransform> path;
  for (int i = 0; i < 25; ++i) {
    path.push_back(translate(0.2 * i - 2.4, 1.2 * std::sin(0.4 * i) - 0.6, 0));
  }
  auto odometry = uncertainPose(turn(0.3, 0.5, -0.25), {0.2, 0.05, 1e12, 1e12, 1e12, 0.03});
  odometry.covariance->at(1) = odometry.covariance->at(6) = 0.06;
  DatasetBuilder builder;
  builder.topic("/tf", scenegraph::ObjectType::FrameTransforms)
      .transform(0, "utm", "map", {.translation = utm_from_map})
      .transform(0, "map", "base", turn(0.3, 0.5, -0.25, 0.125))
      .transform(0, "base", "lidar", turn(-0.7, 0.4, 0.0, 0.9))
      .transform(0, "base", "arm", turn(1.1, -1.0, 1.2, 0.8))
      .topic("/points", scenegraph::ObjectType::PointCloud)
      .at(1_s, cloud.build())
      .topic("/pose_array", scenegraph::ObjectType::PosesInFrame)
      .at(1_s, posesOf(scenegraph::PosesKind::Array, {turn(0.4, -1.6, -1), turn(1.2, -1.2, 0, 0.2), turn(2, -1.6, 1)}))
      .topic("/path", scenegraph::ObjectType::PosesInFrame)
      .at(1_s, posesOf(scenegraph::PosesKind::Path, path))
      .topic("/odometry", scenegraph::ObjectType::PosesInFrame)
      .at(1_s, odometry)
      .topic("/footprint", scenegraph::ObjectType::PosesInFrame)
      .at(1_s, pointsOf(scenegraph::PosesKind::Polygon,
                        {{0.9, 0.4, 0}, {1.9, 0.4, 0}, {2.2, 0.9, 0}, {1.9, 1.4, 0}, {0.9, 1.4, 0}, {1.2, 0.9, 0}}));
  return builder;
}

inline std::shared_ptr<scenegraph::Dataset> robotAt(const glm::dvec3& utm_from_map) {
  return robotBuilderAt(utm_from_map).build();
}

}  // namespace stillframe::test
