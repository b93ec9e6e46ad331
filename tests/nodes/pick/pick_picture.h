#pragma once

#include <algorithm>
#include <string>

#include "scenegraph/pick/scene_pick.h"
#include "tests/nodes/scene_picture.h"

namespace stillframe::test {

/// Scenes that something is picked in.
class PickTest : public ScenePictureTest {
 protected:
  /// Draws the scene anew and says what lies at a pixel.
  std::expected<scenegraph::PickResult, scenegraph::PickError> pickAt(int x, int y, int reach = 8) {
    return scenegraph::describeHits(*scene_, renderer_->pick(x, y, reach));
  }
  static std::string field(const scenegraph::Picked& picked, const std::string& name) {
    const auto found = std::ranges::find(picked.fields, name, &decltype(picked.fields)::value_type::first);
    return found == picked.fields.end() ? "none" : scenegraph::pickText(found->second);
  }
  static void expectPoint(const glm::dvec3& actual, const glm::dvec3& expected, double tolerance = 1e-9) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(actual[axis], expected[axis], tolerance) << "axis " << axis;
    }
  }
};

}  // namespace stillframe::test
