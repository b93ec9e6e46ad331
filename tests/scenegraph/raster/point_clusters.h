#pragma once

#include <array>
#include <cmath>
#include <glm/mat4x4.hpp>
#include <limits>
#include <random>
#include <vector>

#include "scenegraph/raster/sample_order.h"

namespace stillframe::test {

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Reverse-Z, 90 degrees, from the origin along -z.
inline glm::dmat4 perspective(double near_m) {
  glm::dmat4 clip_from_eye(0.0);
  clip_from_eye[0][0] = 1.0;
  clip_from_eye[1][1] = 1.0;
  clip_from_eye[2][3] = -1.0;
  clip_from_eye[3][2] = near_m;
  return clip_from_eye;
}

/// A lidar's cloud: groups of neighbours all around, near and far.
inline std::vector<float> clusters(std::size_t groups) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  std::vector<float> cloud;
  for (std::size_t group = 0; group < groups; ++group) {
    const float reach = std::pow(10.0F, 2.0F * unit(random));
    const std::array<float, 3> centre{reach * unit(random), reach * unit(random), reach * unit(random)};
    for (std::size_t i = 0; i < scenegraph::kPassesOfSample; ++i) {
      for (const float at : centre) {
        cloud.push_back(at + 0.3F * reach * unit(random));
      }
    }
  }
  cloud.resize(cloud.size() - 3 * 700);  // a short last group
  return cloud;
}

}  // namespace stillframe::test
