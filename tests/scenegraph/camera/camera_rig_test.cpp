#include "scenegraph/camera/camera_rig.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "scenegraph/camera/picking.h"
#include "tests/scenegraph/camera/camera_cases.h"
#include "tests/support/builders.h"

namespace stillframe::scenegraph {
namespace {

using test::Random;

CameraState randomState(Random& random) {
  const auto sight = [&] {
    return Sight{{random.number(-1e7, 1e7), random.number(-1e7, 1e7), random.number(-1e7, 1e7)},
                 random.number(-10, 10),
                 random.number(-2, 2),
                 std::pow(10.0, random.number(-7, 10)),
                 random.number(0, 3.2)};
  };
  CameraRig rig;
  CameraState state;
  state.kind = kCameraKinds[random.index(4)];
  state.orbit = sight();
  state.xy_orbit = sight();
  const Sight down = sight();
  state.top_down = {down.focal_point, down.yaw_rad, down.radius_m, down.vertical_fov_rad};
  const Sight fly = sight();
  state.fly = {fly.focal_point, fly.yaw_rad, fly.pitch_rad, fly.radius_m, fly.vertical_fov_rad};
  state.is_in_step = {random.index(2) == 0, random.index(2) == 0, random.index(2) == 0, random.index(2) == 0};
  rig.setState(state);
  return rig.state();
}

TEST(CameraRig, SavedStateComesBackBitForBit) {
  Random random(13);
  for (int i = 0; i < 500; ++i) {
    const CameraState state = randomState(random);
    CameraState read;
    ASSERT_TRUE(applyCameraTexts(cameraTexts(state), read).has_value());
    CameraRig restored;
    restored.setState(read);
    EXPECT_EQ(restored.state(), state);
    EXPECT_EQ(cameraTexts(restored.state()), cameraTexts(state));
  }
}

TEST(CameraRig, RefusesTextsThatAreNoNumbersAndIgnoresUnknownKeys) {
  CameraState state;
  const CameraState before = state;
  for (const char* bad : {"nan", "inf", "", "1.0x", "1e999"}) {
    EXPECT_FALSE(applyCameraTexts({{"orbit.radius_m", bad}, {"orbit.yaw_rad", "1"}}, state).has_value()) << bad;
    EXPECT_EQ(state, before);
  }
  EXPECT_FALSE(applyCameraTexts({{"kind", "spherical"}}, state).has_value());
  EXPECT_TRUE(applyCameraTexts({{"no_such_key", "nan"}, {"orbit.radius_m", "7"}}, state).has_value());
  EXPECT_EQ(state.orbit.radius_m, 7.0);
}

TEST(CameraRig, AStateThatIsNotFiniteIsLeftOut) {
  CameraRig rig;
  CameraState bad = rig.state();
  bad.orbit.radius_m = std::numeric_limits<double>::quiet_NaN();
  bad.fly.eye.x = std::numeric_limits<double>::infinity();
  bad.kind = static_cast<CameraKind>(77);
  rig.setState(bad);
  EXPECT_EQ(rig.state().orbit, CameraState{}.orbit);
  EXPECT_EQ(rig.state().fly, CameraState{}.fly);
  EXPECT_EQ(rig.kind(), CameraKind::Orbit);
}

TEST(CameraRig, SwitchingThereAndBackWithoutMovingRestoresEveryBit) {
  Random random(17);
  for (int i = 0; i < 200; ++i) {
    CameraRig rig;
    rig.setState(randomState(random));
    rig.change();
    const CameraKind start = rig.kind();
    const CameraState before = rig.state();
    const glm::dmat4 view = rig.view().eye_from_fixed;
    for (int step = 0; step < 5; ++step) {
      rig.setKind(kCameraKinds[random.index(4)]);
    }
    rig.setKind(start);
    EXPECT_EQ(rig.view().eye_from_fixed, view);
    switch (start) {
      case CameraKind::Orbit:
        EXPECT_EQ(rig.state().orbit, before.orbit);
        break;
      case CameraKind::XyOrbit:
        EXPECT_EQ(rig.state().xy_orbit, before.xy_orbit);
        break;
      case CameraKind::TopDownOrtho:
        EXPECT_EQ(rig.state().top_down, before.top_down);
        break;
      case CameraKind::Fly:
        EXPECT_EQ(rig.state().fly, before.fly);
        break;
    }
  }
}

TEST(CameraRig, OrbitAndFlyShowTheSamePictureAfterASwitch) {
  Random random(19);
  for (int i = 0; i < 200; ++i) {
    CameraRig rig;
    rig.change().adopt(inRange({{random.number(-50, 50), random.number(-50, 50), 0.0},
                                random.number(-3, 3),
                                random.number(0.2, 1.5),
                                random.number(1, 100),
                                0.9}));
    const glm::dvec3 seen = rig.model().sight().focal_point + glm::dvec3(0.3, -0.2, 0.1);
    const auto before = toScreen(rig.view(), kSize, seen);
    for (const CameraKind kind : {CameraKind::Fly, CameraKind::XyOrbit, CameraKind::Orbit}) {
      rig.setKind(kind);
      rig.change();  // so that the next one takes over from this one
      const auto after = toScreen(rig.view(), kSize, seen);
      EXPECT_NEAR(after->position_px.x, before->position_px.x, 1e-6) << toString(kind);
      EXPECT_NEAR(after->position_px.y, before->position_px.y, 1e-6) << toString(kind);
    }
  }
}

TEST(CameraRig, TopDownKeepsPlaceSizeAndDirectionOfTheView) {
  CameraRig rig;
  rig.change().adopt({{7, 8, 2}, 0.4, 1.0, 30.0, 0.9});
  const auto size_px = [&] {  // along the picture's x, which no tilt shortens
    const glm::dvec3 right = eyeAxes(0.4, 1.0).right;
    return toScreen(rig.view(), kSize, glm::dvec3(7, 8, 2) + right)->position_px.x -
           toScreen(rig.view(), kSize, {7, 8, 2})->position_px.x;
  };
  const double before_px = size_px();
  rig.setKind(CameraKind::TopDownOrtho);
  EXPECT_TRUE(rig.view().is_orthographic);
  EXPECT_NEAR(size_px(), before_px, 1e-9);
  const auto centre = toScreen(rig.view(), kSize, {7, 8, 2});
  EXPECT_NEAR(centre->position_px.x, kSize.width_px / 2, 1e-9);
  EXPECT_NEAR(centre->position_px.y, kSize.height_px / 2, 1e-9);
}

TEST(CameraRig, AModelMovedSinceIsFollowedByTheNext) {
  CameraRig rig;
  rig.setKind(CameraKind::TopDownOrtho);
  rig.change().pan(300, 100, 720);
  const glm::dvec3 centre = rig.model().sight().focal_point;
  rig.setKind(CameraKind::Orbit);
  EXPECT_NEAR(glm::length(rig.model().sight().focal_point - centre), 0.0, 1e-12);
}

TEST(CameraRig, ViewOnTheWayEndsExactlyAtTheView) {
  CameraRig rig;
  const Sight from = rig.model().sight();
  rig.change().adopt({{70, 8, 2}, 2.4, 1.0, 300.0, 0.9});
  EXPECT_EQ(rig.viewFrom(from, 1.0).eye_from_fixed, rig.view().eye_from_fixed);
  EXPECT_NE(rig.viewFrom(from, 0.5).eye_from_fixed, rig.view().eye_from_fixed);
}

}  // namespace
}  // namespace stillframe::scenegraph
