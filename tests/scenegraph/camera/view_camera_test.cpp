#include "scenegraph/camera/view_camera.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "scenegraph/camera/picking.h"
#include "tests/scenegraph/camera/camera_cases.h"
#include "tests/support/builders.h"

namespace stillframe::scenegraph {
namespace {

using test::turn;

constexpr double kEnd = ViewCamera::kMoveSeconds;

TEST(ViewCamera, ASmoothMoveGoesFromWhereItWasToExactlyWhereItEnds) {
  ViewCamera camera;
  const glm::dmat4 start = camera.view(0.0).eye_from_fixed;
  camera.beginMove(10.0, true);
  camera.frame(Box{{50, 50, 0}, {60, 60, 1}}, 1.5);
  EXPECT_EQ(camera.view(10.0).eye_from_fixed, start);
  EXPECT_TRUE(camera.isMoving(10.0 + 0.5 * kEnd));
  ViewCamera at_once;
  at_once.beginMove(10.0, false);
  at_once.frame(Box{{50, 50, 0}, {60, 60, 1}}, 1.5);
  EXPECT_FALSE(at_once.isMoving(10.0));
  EXPECT_NE(camera.view(10.0 + 0.5 * kEnd).eye_from_fixed, at_once.view(10.0).eye_from_fixed);
  EXPECT_FALSE(camera.isMoving(10.0 + kEnd));
  EXPECT_EQ(camera.view(10.0 + kEnd).eye_from_fixed, at_once.view(10.0).eye_from_fixed);
  EXPECT_EQ(camera.state(), at_once.state()) << "what is saved during a move is its end";
}

TEST(ViewCamera, AGestureTakesTheMoveOverWhereItIs) {
  ViewCamera camera;
  camera.beginMove(0.0, true);
  camera.frame(Box{{50, 50, 0}, {60, 60, 1}}, 1.5);
  const glm::dmat4 halfway = camera.view(0.5 * kEnd).eye_from_fixed;
  camera.grasp(0.5 * kEnd).zoom(0.0);
  EXPECT_FALSE(camera.isMoving(0.5 * kEnd));
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      EXPECT_NEAR(camera.view(1e9).eye_from_fixed[column][row], halfway[column][row], 1e-9);
    }
  }
}

TEST(ViewCamera, FramesABoxOfTheFixedFrameWhateverItFollows) {
  const tf::RigidTransform fixed_from_base =
      turn(0.7, 100, 50, 0) * tf::RigidTransform{glm::angleAxis(0.5, glm::dvec3(1, 0, 0)), {0, 0, 0}};
  for (const FollowMode mode : kFollowModes) {
    ViewCamera camera;
    camera.setFollow(mode, fixed_from_base, 0.0);
    camera.recenter(fixed_from_base);
    const Box box{{95, 45, -1}, {105, 55, 3}};
    camera.frame(box, kSize.width_px / kSize.height_px);
    for (unsigned corner = 0; corner < 8; ++corner) {
      const auto at = toScreen(camera.view(0.0), kSize, box.corner(corner));
      ASSERT_TRUE(at) << toString(mode);
      EXPECT_GE(at->position_px.x, 0.0);
      EXPECT_LE(at->position_px.x, kSize.width_px);
      EXPECT_GE(at->position_px.y, 0.0);
      EXPECT_LE(at->position_px.y, kSize.height_px);
    }
    camera.lookAtPoint({97, 52, 1});
    const auto centre = toScreen(camera.view(0.0), kSize, {97, 52, 1});
    EXPECT_NEAR(centre->position_px.x, kSize.width_px / 2, 1e-6) << toString(mode);
    EXPECT_NEAR(centre->position_px.y, kSize.height_px / 2, 1e-6) << toString(mode);
  }
}

TEST(ViewCamera, AnotherDisplayFrameDoesNotMoveTheView) {
  ViewCamera camera;
  camera.setFollow(FollowMode::Pose, turn(0.3, 1, 2, 3), 0.0);
  const glm::dmat4 before = camera.view(0.0).eye_from_fixed;
  camera.setDisplayFrame("lidar", turn(1.9, -4, 2, 8), 0.0);
  EXPECT_EQ(camera.displayFrame(), "lidar");
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      EXPECT_NEAR(camera.view(0.0).eye_from_fixed[column][row], before[column][row], 1e-12);
    }
  }
}

TEST(ViewCamera, SavedViewpointComesBackExactlyEvenWithoutItsFrame) {
  ViewCamera camera;
  camera.setKind(CameraKind::TopDownOrtho, 0.0);
  camera.setDisplayFrame("base", turn(0.3, 1, 2, 3), 0.0);
  camera.setFollow(FollowMode::Heading, turn(0.3, 1, 2, 3), 0.0);
  camera.grasp(0.0).pan(30, 40, 720);
  camera.track(turn(0.5, 2, 2, 3));
  ViewCamera restored;
  restored.setState(camera.state());
  EXPECT_EQ(restored.state(), camera.state());
  EXPECT_FALSE(restored.track(std::nullopt)) << "an absent frame leaves it inert";
  EXPECT_EQ(restored.view(0.0).eye_from_fixed, camera.view(0.0).eye_from_fixed);
  camera.track(turn(0.9, 5, 2, 3));
  restored.track(turn(0.9, 5, 2, 3));
  EXPECT_EQ(restored.view(0.0).eye_from_fixed, camera.view(0.0).eye_from_fixed);
}

}  // namespace
}  // namespace stillframe::scenegraph
