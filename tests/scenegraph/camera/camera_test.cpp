#include "scenegraph/camera/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

#include "scenegraph/camera/orbit_camera.h"
#include "scenegraph/camera/picking.h"
#include "tests/scenegraph/camera/camera_cases.h"
#include "tests/support/builders.h"

namespace stillframe::scenegraph {
namespace {

using test::Random;

bool isFinite(const glm::dmat4& matrix) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(matrix[column][row])) {
        return false;
      }
    }
  }
  return true;
}

/// Largest departure of the rotation from an orthonormal one.
double skew(const glm::dmat4& eye_from_fixed) {
  const glm::dmat3 rotation(eye_from_fixed);
  const glm::dmat3 product = glm::transpose(rotation) * rotation;
  double worst = std::abs(glm::determinant(rotation) - 1.0);
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      worst = std::max(worst, std::abs(product[column][row] - (column == row ? 1.0 : 0.0)));
    }
  }
  return worst;
}

bool isSane(const OrbitCamera& camera) {
  const auto& state = camera.state();
  return isFinite(camera.view().eye_from_fixed) && skew(camera.view().eye_from_fixed) < 1e-12 &&
         std::abs(state.pitch_rad) <= std::numbers::pi / 2.0 && state.radius_m >= 1e-6 && state.radius_m <= 1e9;
}

TEST(LookAt, IsOrthonormalInEveryDegenerateDirection) {
  const glm::dvec3 directions[] = {{0, 0, 1},      {0, 0, -1},    {1, 0, 0},       {0, 1, 0},    {0, -1, 0},  {0, 0, 0},
                                   {1e-300, 0, 0}, {0, 0, 1e300}, {1e-9, 0, -1.0}, {kNan, 0, 0}, {kInf, 0, 0}};
  for (const glm::dvec3& direction : directions) {
    for (const glm::dvec3& up : directions) {
      EXPECT_LT(skew(lookAt({0, 0, 0}, direction, up)), 1e-12)
          << direction.x << " " << direction.y << " " << direction.z;
    }
  }
}

TEST(LookAt, PutsTheTargetAheadAndUpUpwards) {
  const glm::dmat4 eye_from_fixed = lookAt({10, 0, 0}, {0, 0, 0}, {0, 0, 1});
  const glm::dvec4 target = eye_from_fixed * glm::dvec4(0, 0, 0, 1);
  EXPECT_NEAR(target.z, -10.0, 1e-12);
  EXPECT_NEAR((eye_from_fixed * glm::dvec4(0, 0, 1, 1)).y, 1.0, 1e-12);
  EXPECT_NEAR((eye_from_fixed * glm::dvec4(0, 1, 0, 1)).x, 1.0, 1e-12);
}

TEST(Projection, DepthIsOneAtNearAndFallsToZeroAtInfinity) {
  const glm::dmat4 clip_from_eye = reverseZInfinitePerspective(1.0, 1.5, 0.05);
  double last = 2.0;
  for (const double distance : {0.05, 0.1, 1.0, 1e3, 1e7, 1e12}) {
    const glm::dvec4 clip = clip_from_eye * glm::dvec4(0, 0, -distance, 1);
    const double depth = clip.z / clip.w;
    EXPECT_NEAR(depth, 0.05 / distance, 1e-12);
    EXPECT_LT(depth, last);
    last = depth;
  }
}

TEST(Projection, SurvivesCollapsedInput) {
  for (const double bad : {0.0, -1.0, kNan, kInf, -kInf}) {
    EXPECT_TRUE(isFinite(reverseZInfinitePerspective(1.0, bad, 0.1))) << bad;
    EXPECT_TRUE(isFinite(reverseZInfinitePerspective(bad, 1.0, 0.1))) << bad;
    EXPECT_TRUE(isFinite(reverseZInfinitePerspective(1.0, 1.0, bad))) << bad;
    EXPECT_TRUE(isFinite(reverseZOrthographic(bad, bad, bad))) << bad;
  }
  EXPECT_EQ(reverseZInfinitePerspective(1.0, 0.0, 0.1), reverseZInfinitePerspective(1.0, 1.0, 0.1));
}

TEST(Projection, OrthographicDepthRunsFromOneInFrontToZeroBehindTheFarEnd) {
  const glm::dmat4 clip_from_eye = reverseZOrthographic(20.0, 2.0, 100.0);
  EXPECT_NEAR((clip_from_eye * glm::dvec4(0, 0, 100, 1)).z, 1.0, 1e-12);
  EXPECT_NEAR((clip_from_eye * glm::dvec4(0, 0, -100, 1)).z, 0.0, 1e-12);
  EXPECT_NEAR((clip_from_eye * glm::dvec4(20, 10, 0, 1)).x, 1.0, 1e-12);
  EXPECT_NEAR((clip_from_eye * glm::dvec4(20, 10, 0, 1)).y, 1.0, 1e-12);
}

TEST(OrbitCamera, StaysSaneUnderEveryGestureWithEveryInput) {
  const double inputs[] = {0.0, 1.0, -1.0, 1e-300, 1e300, -1e300, kNan, kInf, -kInf, 720.0};
  for (const double a : inputs) {
    for (const double b : inputs) {
      for (const double height : inputs) {
        OrbitCamera camera;
        camera.rotate(a, b, height);
        camera.pan(a, b, height);
        camera.zoom(a);
        camera.dolly(b, height);
        camera.setLookAt({a, b, height}, {b, a, a});
        camera.frame(Box{{a, a, a}, {b, b, height}}, height);
        ASSERT_TRUE(isSane(camera)) << a << " " << b << " " << height;
      }
    }
  }
}

TEST(OrbitCamera, NonFiniteInputChangesNothing) {
  OrbitCamera camera;
  const OrbitCamera::State before = camera.state();
  camera.rotate(kNan, 0, 720);
  camera.rotate(1, 1, 0);
  camera.pan(kInf, 0, 720);
  camera.zoom(kNan);
  camera.zoom(kInf);
  camera.dolly(1, 0);
  camera.frame(Box{}, 1.0);
  camera.setLookAt({kNan, 0, 0}, {0, 0, 0});
  OrbitCamera::State bad = before;
  bad.radius_m = kNan;
  camera.setState(bad);
  EXPECT_EQ(camera.state(), before);
}

TEST(OrbitCamera, TenThousandWheelStepsEitherWayStayInRange) {
  OrbitCamera camera;
  for (int i = 0; i < 10'000; ++i) {
    camera.zoom(1.0);
  }
  EXPECT_DOUBLE_EQ(camera.state().radius_m, 1e-6);
  EXPECT_TRUE(isSane(camera));
  camera.zoom(-10'000.0);
  EXPECT_DOUBLE_EQ(camera.state().radius_m, 1e9);
  EXPECT_TRUE(isSane(camera));
}

TEST(OrbitCamera, AWheelStepTakesATenthOffTheRadiusAndKeepsTheTarget) {
  OrbitCamera camera;
  const OrbitCamera::State before = camera.state();
  camera.zoom(1.0);
  EXPECT_NEAR(camera.state().radius_m, 0.9 * before.radius_m, 1e-12);
  EXPECT_EQ(camera.state().focal_point, before.focal_point);
}

TEST(OrbitCamera, LooksStraightDownAndUpWithAnOrthonormalView) {
  OrbitCamera camera;
  camera.rotate(0, 1e6, 720);
  EXPECT_DOUBLE_EQ(camera.state().pitch_rad, std::numbers::pi / 2.0);
  EXPECT_TRUE(isSane(camera));
  EXPECT_NEAR(camera.eye().z, 10.0, 1e-12);
  camera.rotate(0, -2e6, 720);
  EXPECT_DOUBLE_EQ(camera.state().pitch_rad, -std::numbers::pi / 2.0);
  EXPECT_TRUE(isSane(camera));
}

TEST(OrbitCamera, ManyTurnsKeepTheYawSmall) {
  OrbitCamera camera;
  for (int i = 0; i < 100'000; ++i) {
    camera.rotate(517.0, 0.0, 720.0);
  }
  EXPECT_LE(std::abs(camera.state().yaw_rad), std::numbers::pi);
}

TEST(OrbitCamera, TheSceneFollowsTheCursorWhenRotating) {
  OrbitCamera camera;
  const glm::dvec3 nearer_than_focus = camera.eye() * 0.1;  // the focal point is the origin
  const auto before = toScreen(camera.view(), kSize, nearer_than_focus);
  camera.rotate(10, 0, kSize.height_px);
  EXPECT_GT(toScreen(camera.view(), kSize, nearer_than_focus)->position_px.x, before->position_px.x);
  camera = {};
  camera.rotate(0, 10, kSize.height_px);
  EXPECT_GT(toScreen(camera.view(), kSize, nearer_than_focus)->position_px.y, before->position_px.y);
}

TEST(OrbitCamera, PanKeepsThePointAtTheFocalDepthUnderTheCursor) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    OrbitCamera camera;
    camera.setState({.focal_point = kEcef * random.number(-1, 1),
                     .yaw_rad = random.number(-3, 3),
                     .pitch_rad = random.number(-1.57, 1.57),
                     .radius_m = std::pow(10.0, random.number(0, 6)),
                     .vertical_fov_rad = random.number(0.2, 2.0)});
    const glm::dvec3 grabbed = camera.state().focal_point;
    const double dx = random.number(-500, 500);
    const double dy = random.number(-300, 300);
    camera.pan(dx, dy, kSize.height_px);
    const auto moved = toScreen(camera.view(), kSize, grabbed);
    ASSERT_TRUE(moved);
    EXPECT_NEAR(moved->position_px.x, kSize.width_px / 2 + dx, 1e-5);
    EXPECT_NEAR(moved->position_px.y, kSize.height_px / 2 + dy, 1e-5);
  }
}

TEST(OrbitCamera, APointNearAnEyeInEcefFallsOnTheSamePixelAsAtTheOrigin) {
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 eye(random.number(-20, 20), random.number(-20, 20), random.number(-20, 20));
    const glm::dvec3 target(random.number(-2, 2), random.number(-2, 2), random.number(-2, 2));
    const glm::dvec3 point(random.number(-2, 2), random.number(-2, 2), random.number(-2, 2));
    if (glm::length(eye - target) < 8.0) {
      continue;
    }
    // Multiples of 2^-20, so that the offset itself rounds nothing away.
    const auto exact = [](const glm::dvec3& v) { return glm::round(v * 0x1p20) * 0x1p-20; };
    OrbitCamera here;
    here.setLookAt(exact(eye), exact(target));
    OrbitCamera far;
    far.setLookAt(kEcef + exact(eye), kEcef + exact(target));
    const auto near_px = toScreen(here.view(), kSize, exact(point));
    const auto far_px = toScreen(far.view(), kSize, kEcef + exact(point));
    ASSERT_TRUE(near_px && far_px);
    EXPECT_NEAR(near_px->position_px.x, far_px->position_px.x, 1e-6);
    EXPECT_NEAR(near_px->position_px.y, far_px->position_px.y, 1e-6);
  }
}

TEST(OrbitCamera, FrameShowsEveryCornerAtEveryScaleAndAspect) {
  Random random(9);
  for (int i = 0; i < 300; ++i) {
    const double scale = std::pow(10.0, random.number(-5, 7));
    const glm::dvec3 low(random.number(-scale, scale), random.number(-scale, scale), random.number(-scale, scale));
    const glm::dvec3 high = low + glm::dvec3(random.number(0, scale), random.number(0, scale), random.number(0, scale));
    const double aspect = std::pow(10.0, random.number(-1, 1));
    OrbitCamera camera;
    camera.rotate(random.number(-900, 900), random.number(-900, 900), 720.0);
    camera.frame(Box{low, high}, aspect);
    for (unsigned corner = 0; corner < 8; ++corner) {
      const glm::dvec3 point((corner & 1U) != 0 ? high.x : low.x, (corner & 2U) != 0 ? high.y : low.y,
                             (corner & 4U) != 0 ? high.z : low.z);
      const auto at = toScreen(camera.view(), {1000.0 * aspect, 1000.0}, point);
      ASSERT_TRUE(at) << scale;
      EXPECT_GE(at->position_px.x, -1e-6);
      EXPECT_LE(at->position_px.x, 1000.0 * aspect + 1e-6);
      EXPECT_GE(at->position_px.y, -1e-6);
      EXPECT_LE(at->position_px.y, 1000.0 + 1e-6);
    }
  }
}

TEST(OrbitCamera, LookAtPlacesTheEyeThere) {
  OrbitCamera camera;
  camera.setLookAt({3, -4, 12}, {1, 2, 3});
  EXPECT_NEAR(glm::length(camera.eye() - glm::dvec3(3, -4, 12)), 0.0, 1e-12);
  EXPECT_EQ(camera.state().focal_point, glm::dvec3(1, 2, 3));
}

TEST(OrbitCamera, LookAtStraightDownHasYUpInThePicture) {
  OrbitCamera camera;
  camera.setLookAt({0, 0, 10}, {0, 0, 0});
  const auto north = toScreen(camera.view(), kSize, {0, 1, 0});
  EXPECT_NEAR(north->position_px.x, kSize.width_px / 2, 1e-9);
  EXPECT_LT(north->position_px.y, kSize.height_px / 2);
}

}  // namespace
}  // namespace stillframe::scenegraph
