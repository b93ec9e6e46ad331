// What holds for every model of a camera, whatever comes in.
#include "scenegraph/camera/camera_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

#include "scenegraph/camera/camera_rig.h"
#include "scenegraph/camera/picking.h"
#include "tests/scenegraph/camera/camera_cases.h"
#include "tests/support/builders.h"

namespace stillframe::scenegraph {
namespace {

using test::Random;

/// Everything of the view is finite, its rotation orthonormal, and the projection usable at any aspect.
testing::AssertionResult isSane(const CameraModel& model) {
  const CameraView view = model.view();
  const glm::dmat3 rotation(view.eye_from_fixed);
  const glm::dmat3 product = glm::transpose(rotation) * rotation;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (!(std::abs(product[column][row] - (column == row ? 1.0 : 0.0)) < 1e-12)) {
        return testing::AssertionFailure() << "the rotation is skewed";
      }
    }
    if (!std::isfinite(view.eye_from_fixed[3][column])) {
      return testing::AssertionFailure() << "the eye is not finite";
    }
  }
  for (const double aspect : {0.0, 1e-300, 1.0, 1e300, kNan, kInf}) {
    const glm::dmat4 clip_from_eye = projection(view, aspect);
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) {
        if (!std::isfinite(clip_from_eye[column][row])) {
          return testing::AssertionFailure() << "the projection is not finite at aspect " << aspect;
        }
      }
    }
  }
  if (!isFinite(model.sight()) || !(inRange(model.sight()) == model.sight())) {
    return testing::AssertionFailure() << "the sight is out of range";
  }
  return testing::AssertionSuccess();
}

Sight randomSight(Random& random) {
  return inRange({.focal_point = glm::dvec3(random.number(-50, 50), random.number(-50, 50), random.number(-5, 5)),
                  .yaw_rad = random.number(-3, 3),
                  .pitch_rad = random.number(-1.5, 1.5),
                  .radius_m = std::pow(10.0, random.number(-1, 3)),
                  .vertical_fov_rad = random.number(0.3, 1.5)});
}

class EveryCamera : public testing::TestWithParam<CameraKind> {
 protected:
  EveryCamera() { rig.setKind(GetParam()); }
  CameraModel& model() { return rig.change(); }
  CameraRig rig;
};

TEST_P(EveryCamera, StaysSaneUnderEveryGestureWithEveryInput) {
  const double inputs[] = {0.0, 1.0, -1.0, 1e-300, 1e300, -1e300, kNan, kInf, -kInf, 720.0};
  for (const double a : inputs) {
    for (const double b : inputs) {
      for (const double height : inputs) {
        rig.setState({});
        rig.setKind(GetParam());
        model().rotate(a, b, height);
        model().pan(a, b, height);
        model().zoom(a);
        model().zoomAt(b, {a, b}, height);
        model().dolly(b, height);
        model().walk({a, b, height}, b);
        model().frame(Box{{a, a, a}, {b, b, height}}, height);
        model().carry(a, {b, height, a});
        model().adopt({{a, b, height}, a, b, height, a});
        ASSERT_TRUE(isSane(rig.model())) << a << " " << b << " " << height;
        ASSERT_TRUE(isSane(OrbitCamera())) << "the check itself";
      }
    }
  }
}

TEST_P(EveryCamera, InputThatIsNotFiniteChangesNothing) {
  const CameraState before = rig.state();
  for (const double bad : {kNan, kInf, -kInf}) {
    model().rotate(bad, 0, 720);
    model().rotate(1, 1, 0);
    model().pan(bad, 0, 720);
    model().pan(0, bad, 720);
    model().zoom(kNan);
    model().zoomAt(kNan, {0, 0}, 720);
    model().walk({bad, 0, 0}, 1);
    model().walk({1, 0, 0}, bad);
    model().frame(Box{}, 1.0);
    model().frame(Box{{bad, 0, 0}, {bad, 1, 1}}, 1.0);
    model().carry(bad, {0, 0, 0});
    model().adopt({{bad, 0, 0}, 0, 0, 1, 1});
  }
  CameraState after = rig.state();
  after.is_in_step = before.is_in_step;
  EXPECT_EQ(after, before);
}

TEST_P(EveryCamera, TenThousandWheelStepsEitherWayStaySaneAndCanBeUndone) {
  for (const double direction : {1.0, -1.0}) {
    for (int i = 0; i < 10'000; ++i) {
      model().zoom(direction);
    }
    ASSERT_TRUE(isSane(rig.model()));
    for (int i = 0; i < 10'000; ++i) {
      model().zoomAt(direction, {300, -200}, 720);
    }
    ASSERT_TRUE(isSane(rig.model()));
  }
  model().zoom(1e6);
  model().zoom(-1e6);
  ASSERT_TRUE(isSane(rig.model()));
  model().frame(Box{{-1, -1, -1}, {1, 1, 1}}, 1.0);
  EXPECT_LT(glm::length(eyeOf(rig.model().sight())), 1e3) << "F brings it back from anywhere";
}

TEST_P(EveryCamera, IsSaneAtEveryRadiusAndStraightUpAndDown) {
  for (const double radius : {0.0, 1e-300, 1e-6, 1e-3, 1.0, 1e6, 1e9, 1e30}) {
    for (const double pitch : {-std::numbers::pi / 2, -1.57, 0.0, 1.57, std::numbers::pi / 2, 1e9}) {
      for (const glm::dvec3& at : {glm::dvec3(0.0), kEcef, kEcef * 1e5}) {
        model().adopt({at, 0.7, pitch, radius, 0.9});
        ASSERT_TRUE(isSane(rig.model())) << radius << " " << pitch;
        model().rotate(13, 7, 720);
        model().pan(13, 7, 720);
        ASSERT_TRUE(isSane(rig.model())) << radius << " " << pitch;
      }
    }
  }
}

TEST_P(EveryCamera, EyeOnTheTargetIsSurvived) {
  model().adopt(lookingFrom({1, 2, 3}, {1, 2, 3}, Sight{}));
  EXPECT_TRUE(isSane(rig.model()));
}

TEST_P(EveryCamera, ACollapsedWidgetMovesNothing) {
  const CameraState before = rig.state();
  model().rotate(5, 5, 0.0);
  model().pan(5, 5, 0.0);
  model().dolly(0.0, 0.0);
  CameraState after = rig.state();
  after.is_in_step = before.is_in_step;
  EXPECT_EQ(after, before);
}

TEST_P(EveryCamera, PanKeepsWhatIsLookedAtUnderTheCursor) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    Sight sight = randomSight(random);
    sight.pitch_rad = random.number(1.2, 1.5);  // the one on the ground keeps it where the ground is seen from above
    model().adopt(sight);
    const glm::dvec3 grabbed = rig.model().sight().focal_point;
    const double dx = random.number(-50, 50);
    const double dy = random.number(-50, 50);
    model().pan(dx, dy, kSize.height_px);
    const auto moved = toScreen(rig.view(), kSize, grabbed);
    ASSERT_TRUE(moved);
    // On the ground, perspective bends the way a little.
    const double tolerance_px = GetParam() == CameraKind::XyOrbit ? 3.0 : 1e-5;
    EXPECT_NEAR(moved->position_px.x, kSize.width_px / 2 + dx, tolerance_px);
    EXPECT_NEAR(moved->position_px.y, kSize.height_px / 2 + dy, tolerance_px);
  }
}

TEST_P(EveryCamera, ZoomAtKeepsWhatIsUnderTheCursorThere) {
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    Sight sight = randomSight(random);
    sight.pitch_rad = std::numbers::pi / 2;  // what lies at the focal depth lies on the ground too
    model().adopt(sight);
    const Sight now = rig.model().sight();
    const EyeAxes axes = eyeAxes(now.yaw_rad, now.pitch_rad);
    const double m_per_px = 2.0 * now.radius_m * std::tan(now.vertical_fov_rad / 2.0) / kSize.height_px;
    const glm::dvec2 from_centre(random.number(-300, 300), random.number(-300, 300));
    const glm::dvec3 aimed_at = now.focal_point + m_per_px * (from_centre.x * axes.right - from_centre.y * axes.up);
    model().zoomAt(random.number(-3, 6), from_centre, kSize.height_px);
    const auto at = toScreen(rig.view(), kSize, aimed_at);
    ASSERT_TRUE(at);
    EXPECT_NEAR(at->position_px.x, kSize.width_px / 2 + from_centre.x, 1e-4);
    EXPECT_NEAR(at->position_px.y, kSize.height_px / 2 + from_centre.y, 1e-4);
  }
}

TEST_P(EveryCamera, FrameShowsEveryCornerAtEveryScaleAndAspect) {
  Random random(9);
  for (int i = 0; i < 300; ++i) {
    const double scale = std::pow(10.0, random.number(-4, 3.5));
    const glm::dvec3 low(random.number(-scale, scale), random.number(-scale, scale), random.number(-scale, scale));
    const glm::dvec3 high = low + glm::dvec3(random.number(0, scale), random.number(0, scale), random.number(0, scale));
    const double aspect = std::pow(10.0, random.number(-1, 1));
    rig.reset();
    model().rotate(random.number(-900, 900), random.number(-300, 300), 720.0);
    model().frame(Box{low, high}, aspect);
    for (unsigned corner = 0; corner < 8; ++corner) {
      const auto at = toScreen(rig.view(), {1000.0 * aspect, 1000.0}, Box{low, high}.corner(corner));
      ASSERT_TRUE(at) << scale;
      EXPECT_GE(at->position_px.x, -1e-6);
      EXPECT_LE(at->position_px.x, 1000.0 * aspect + 1e-6);
      EXPECT_GE(at->position_px.y, -1e-6);
      EXPECT_LE(at->position_px.y, 1000.0 + 1e-6);
    }
  }
}

TEST_P(EveryCamera, CarriedIntoAnotherFrameItShowsTheSame) {
  Random random(11);
  for (int i = 0; i < 100; ++i) {
    model().adopt(randomSight(random));
    const double yaw = random.number(-3, 3);
    const glm::dvec3 translation(random.number(-100, 100), random.number(-100, 100), random.number(-100, 100));
    const glm::dmat4 before = rig.view().eye_from_fixed;
    rig.carry(yaw, translation);
    const tf::RigidTransform new_from_old = test::turn(yaw, translation.x, translation.y, translation.z);
    const glm::dmat4 after = rig.view().eye_from_fixed * tf::toMatrix(new_from_old);
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) {
        EXPECT_NEAR(after[column][row], before[column][row], 1e-10);
      }
    }
  }
}

TEST_P(EveryCamera, WalksTheWayTheKeysSay) {
  model().adopt({{0, 0, 0}, -std::numbers::pi / 2, 0.8, 10.0, 0.9});  // looks along +y
  const glm::dvec3 before = rig.model().sight().focal_point;
  model().walk({1, 0, 0}, 0.5);
  EXPECT_GT(rig.model().sight().focal_point.x, before.x + 1.0);
  const glm::dvec3 beside = rig.model().sight().focal_point;
  model().walk({0, 0, 1}, 0.5);
  EXPECT_GT(rig.model().sight().focal_point.y, beside.y + 1.0);
}

TEST_P(EveryCamera, WheelForwardMakesWhatIsLookedAtLarger) {
  model().adopt({{0, 0, 0}, 0.3, 1.2, 10.0, 0.9});
  const auto distance_px = [&] {
    const auto a = toScreen(rig.view(), kSize, {0, 0, 0});
    const auto b = toScreen(rig.view(), kSize, {0.5, 0.5, 0});
    return glm::length(a->position_px - b->position_px);
  };
  const double before = distance_px();
  model().zoom(1.0);
  EXPECT_NEAR(distance_px() / before, 1.0 / 0.9, 0.02);
}

std::string kindName(const testing::TestParamInfo<CameraKind>& info) { return std::string(toString(info.param)); }

INSTANTIATE_TEST_SUITE_P(Camera, EveryCamera, testing::ValuesIn(kCameraKinds), kindName);

TEST(XyOrbitCamera, KeepsItsFocalPointOnTheGround) {
  Random random(5);
  XyOrbitCamera camera;
  for (int i = 0; i < 1000; ++i) {
    camera.pan(random.number(-50, 50), random.number(-50, 50), 720);
    camera.rotate(random.number(-50, 50), random.number(-50, 50), 720);
    camera.walk({random.number(-1, 1), random.number(-1, 1), random.number(-1, 1)}, 0.1);
    camera.adopt(randomSight(random));
    EXPECT_EQ(camera.state().focal_point.z, 0.0);
  }
}

TEST(XyOrbitCamera, TakesOverAViewOfTheGroundUnchanged) {
  OrbitCamera orbit;
  orbit.setLookAt({10, 5, 8}, {2, 1, 3});
  XyOrbitCamera camera;
  camera.adopt(orbit.state());
  const glm::dmat4 before = orbit.view().eye_from_fixed;
  const glm::dmat4 after = camera.view().eye_from_fixed;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      EXPECT_NEAR(after[column][row], before[column][row], 1e-12);
    }
  }
}

TEST(TopDownCamera, ShowsAMetreAtOneSizeAnywhere) {
  TopDownCamera camera;
  camera.setState({.centre = {3, 4, 5}, .yaw_rad = -std::numbers::pi / 2, .vertical_extent_m = 20.0});
  const auto a = toScreen(camera.view(), kSize, {3, 4, -70});
  const auto b = toScreen(camera.view(), kSize, {4, 4, 900});
  const auto c = toScreen(camera.view(), kSize, {3, 5, 0});
  ASSERT_TRUE(a && b && c);
  EXPECT_NEAR(b->position_px.x - a->position_px.x, kSize.height_px / 20.0, 1e-9);
  EXPECT_NEAR(b->position_px.y, a->position_px.y, 1e-9);
  EXPECT_NEAR(a->position_px.y - c->position_px.y, kSize.height_px / 20.0, 1e-9) << "+y is up";
}

TEST(FlyCamera, LooksAboutWithTheEyeStandingStill) {
  FlyCamera camera;
  const glm::dvec3 eye = camera.state().eye;
  camera.rotate(200, -100, 720);
  EXPECT_EQ(camera.state().eye, eye);
  EXPECT_LT(camera.state().pitch_rad, Sight{}.pitch_rad) << "dragging up looks up";
}

TEST(FlyCamera, PaceScalesTheWayAndStaysInRange) {
  FlyCamera camera;
  const double before = camera.state().reach_m;
  camera.changePace(1.0);
  EXPECT_NEAR(camera.state().reach_m, 1.25 * before, 1e-12);
  for (const double steps : {1e9, -1e9, kNan}) {
    camera.changePace(steps);
    EXPECT_TRUE(isSane(camera)) << steps;
  }
}

TEST(MixOfSights, IsExactAtItsEndsAndTurnsTheShortWay) {
  Random random(21);
  for (int i = 0; i < 200; ++i) {
    const Sight from = randomSight(random);
    const Sight to = randomSight(random);
    EXPECT_EQ(mix(from, to, 0.0), from);
    EXPECT_EQ(mix(from, to, 1.0), to);
    EXPECT_EQ(mix(from, to, kNan), to);
    const Sight half = mix(from, to, 0.5);
    EXPECT_LE(std::abs(std::remainder(half.yaw_rad - from.yaw_rad, 2 * std::numbers::pi)), std::numbers::pi / 2 + 1e-9);
    EXPECT_NEAR(half.radius_m, std::sqrt(from.radius_m * to.radius_m), 1e-9 * half.radius_m);
  }
}

}  // namespace
}  // namespace stillframe::scenegraph
