#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>

#include "tests/support/builders.h"

namespace stillframe::test {

/// A wavy surface of 60 x 40 points with intensity and packed colours, and frames of a small robot; `map` lies at
/// `utm_from_map` in the frame "utm". For more topics.
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
  DatasetBuilder builder;
  builder.topic("/tf", scenegraph::ObjectType::FrameTransforms)
      .transform(0, "utm", "map", {.translation = utm_from_map})
      .transform(0, "map", "base", turn(0.3, 0.5, -0.25, 0.125))
      .transform(0, "base", "lidar", turn(-0.7, 0.4, 0.0, 0.9))
      .transform(0, "base", "arm", turn(1.1, -1.0, 1.2, 0.8))
      .topic("/points", scenegraph::ObjectType::PointCloud)
      .at(1_s, cloud.build());
  return builder;
}

inline std::shared_ptr<scenegraph::Dataset> robotAt(const glm::dvec3& utm_from_map) {
  return robotBuilderAt(utm_from_map).build();
}

}  // namespace stillframe::test
