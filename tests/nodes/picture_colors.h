#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/points/colormap.h"
#include "tests/nodes/scene_picture.h"

namespace stillframe::test {

/// The bytes of a colormap's colour.
inline Bytes3 colorAt(const char* colormap, double t) {
  const nodes::SrgbColor color = nodes::findColormap(colormap)->at(t);
  return {static_cast<int>(std::lround(color[0] * 255.0F)), static_cast<int>(std::lround(color[1] * 255.0F)),
          static_cast<int>(std::lround(color[2] * 255.0F))};
}

inline void expectNear(const Bytes3& actual, const Bytes3& expected, int tolerance = 3) {
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(actual[i], expected[i], tolerance)
        << testing::PrintToString(actual) << " instead of " << testing::PrintToString(expected);
  }
}

}  // namespace stillframe::test
