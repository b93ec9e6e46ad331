#include "scenegraph/camera/follow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scenegraph/camera/picking.h"
#include "tests/scenegraph/camera/camera_cases.h"
#include "tests/support/builders.h"

namespace stillframe::scenegraph {
namespace {

using test::Random;
using test::translate;
using test::turn;
using tf::RigidTransform;

constexpr double kPi = std::numbers::pi;

glm::dquat about(const glm::dvec3& axis, double angle_rad) { return glm::angleAxis(angle_rad, axis); }

/// Largest difference of two views, in the normalised coordinates of points about what is looked at.
double difference(const CameraView& a, const CameraView& b, const RigidTransform& fixed_from_points, double radius_m) {
  double worst = 0.0;
  for (int i = 0; i < 27; ++i) {
    const glm::dvec3 point_in_frame(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    const glm::dvec3 point = tf::transformPoint(fixed_from_points, 0.2 * radius_m * point_in_frame);
    const glm::dvec4 in_a = projection(a, 1.5) * a.eye_from_fixed * glm::dvec4(point, 1.0);
    const glm::dvec4 in_b = projection(b, 1.5) * b.eye_from_fixed * glm::dvec4(point, 1.0);
    worst = std::max({worst, std::abs(in_a.x / in_a.w - in_b.x / in_b.w), std::abs(in_a.y / in_a.w - in_b.y / in_b.w)});
  }
  return worst;
}

class EveryCameraFollows : public testing::TestWithParam<CameraKind> {
 protected:
  EveryCameraFollows() {
    rig.change().adopt({{2, 1, 0.5}, 0.8, 0.6, 12.0, 0.9});
    rig.setKind(GetParam());
    rig.change();
  }
  CameraView view() const { return follow.view(rig.view()); }
  RigidTransform seen() const {
    return {glm::dquat(1, 0, 0, 0), tf::transformPoint(follow.fixedFromCamera(), rig.model().sight().focal_point)};
  }

  CameraRig rig;
  Follow follow;
};

TEST_P(EveryCameraFollows, NothingJumpsWhateverIsSwitchedWhenever) {
  Random random(31);
  RigidTransform fixed_from_frame = random.transform(30.0);
  for (int i = 0; i < 400; ++i) {
    const CameraView before = view();
    const RigidTransform place = seen();
    const double radius_m = rig.model().sight().radius_m;
    follow.setMode(kFollowModes[random.index(4)], fixed_from_frame, rig);
    ASSERT_LT(difference(before, view(), place, radius_m), 1e-9) << i;
    if (i % 3 == 0) {  // another frame
      fixed_from_frame = random.transform(30.0);
      follow.setMode(follow.mode(), fixed_from_frame, rig);
      ASSERT_LT(difference(before, view(), place, radius_m), 1e-9) << i;
    }
    EXPECT_NEAR(rig.model().sight().radius_m, radius_m, 1e-9 * radius_m) << "the zoom is the user's";
    fixed_from_frame = fixed_from_frame * RigidTransform{about({0, 0, 1}, 0.1), {0.5, 0.0, 0.0}};
    follow.track(fixed_from_frame, rig);
    rig.change().rotate(random.number(-20, 20), random.number(-5, 5), 720);
  }
}

TEST_P(EveryCameraFollows, PoseKeepsThePictureOfTheFrameConstant) {
  for (const glm::dvec3& origin : {glm::dvec3(0.0), glm::dvec3(450'000.0, 5'400'000.0, 300.0)}) {
    rig.setState({});
    rig.setKind(GetParam());
    follow = {};
    Random random(37);
    RigidTransform fixed_from_frame{about({0, 0, 1}, 0.3), origin};
    follow.setMode(FollowMode::Pose, fixed_from_frame, rig);
    follow.recenter(fixed_from_frame, rig);
    const CameraView before = view();
    const RigidTransform start = fixed_from_frame;
    for (int i = 0; i < 500; ++i) {
      fixed_from_frame.rotation = random.transform(1.0).rotation;
      fixed_from_frame.translation = origin + glm::dvec3(i * 0.7, std::sin(i), 0.1 * i);
      follow.track(fixed_from_frame, rig);
      // The same points of the frame, each time where the frame is.
      double worst = 0.0;
      for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 in_frame((corner & 1) - 0.5, (corner >> 1 & 1) - 0.5, (corner >> 2 & 1) - 0.5);
        const auto then = toScreen(before, kSize, tf::transformPoint(start, in_frame));
        const auto now = toScreen(view(), kSize, tf::transformPoint(fixed_from_frame, in_frame));
        ASSERT_TRUE(then && now);
        worst = std::max(worst, glm::length(now->position_px - then->position_px) / kSize.height_px);
      }
      ASSERT_LT(worst, 1e-9) << "of the picture's height, at " << i;
    }
  }
}

TEST_P(EveryCameraFollows, PositionGoesAlongAndKeepsItsDirection) {
  RigidTransform fixed_from_frame = turn(0.4, 5, 6, 0);
  follow.setMode(FollowMode::Position, fixed_from_frame, rig);
  const CameraView before = view();
  fixed_from_frame = RigidTransform{about({1, 0, 0}, 1.0), {15, 4, 2}};
  EXPECT_TRUE(follow.track(fixed_from_frame, rig));
  const glm::dmat4 moved = view().eye_from_fixed * tf::toMatrix(translate(10, -2, 2));
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      EXPECT_NEAR(moved[column][row], before.eye_from_fixed[column][row], 1e-12);
    }
  }
}

TEST_P(EveryCameraFollows, HeadingTurnsWithTheFrameAndStaysUpright) {
  RigidTransform fixed_from_frame = turn(0.4, 5, 6, 0);
  follow.setMode(FollowMode::Heading, fixed_from_frame, rig);
  const CameraView before = view();
  const RigidTransform new_from_old = turn(1.1, 3, -2, 0.5);
  follow.track(new_from_old * fixed_from_frame * RigidTransform{about({0, 1, 0}, 0.3), {}}, rig);
  const glm::dmat4 rotated(view().eye_from_fixed * tf::toMatrix(turn(1.1)));
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      EXPECT_NEAR(rotated[column][row], before.eye_from_fixed[column][row], 0.1) << "the turn, whatever the pitch";
    }
  }
  EXPECT_NEAR(view().eye_from_fixed[2][0], before.eye_from_fixed[2][0], 1e-12) << "z stays upright in the picture";
}

TEST_P(EveryCameraFollows, AFrameThatIsAbsentKeepsTheViewUntilItAppears) {
  const CameraView before = view();
  follow.setMode(FollowMode::Pose, std::nullopt, rig);
  EXPECT_TRUE(follow.state().is_waiting);
  EXPECT_FALSE(follow.track(std::nullopt, rig));
  EXPECT_EQ(view().eye_from_fixed, before.eye_from_fixed);
  const RigidTransform fixed_from_frame{about({0.6, 0.8, 0}, 0.5), {3, 4, 5}};
  follow.track(fixed_from_frame, rig);
  EXPECT_LT(difference(before, view(), seen(), 12.0), 1e-9) << "nor does it jump then";
  EXPECT_FALSE(follow.state().is_waiting);
  const CameraView taken_up = view();
  follow.track(std::nullopt, rig);
  EXPECT_EQ(view().eye_from_fixed, taken_up.eye_from_fixed) << "gone again: it stays where it was";
}

TEST_P(EveryCameraFollows, ANewViewStandsUprightInTheFixedFrameUntilItsFrameAppears) {
  follow.setMode(FollowMode::Pose, RigidTransform{about({0.6, 0.8, 0}, 0.5), {3, 4, 5}}, rig);
  follow.reset(std::nullopt);
  EXPECT_EQ(follow.fixedFromCamera().rotation, glm::dquat(1, 0, 0, 0));
  EXPECT_TRUE(follow.state().is_waiting);
  const CameraView before = view();
  follow.track(RigidTransform{about({0, 0.6, 0.8}, 0.7), {3, 4, 5}}, rig);
  EXPECT_LT(difference(before, view(), seen(), 12.0), 1e-9);
}

TEST_P(EveryCameraFollows, RecenterBringsTheFrameToTheMiddleAndKeepsTheDistance) {
  Random random(41);
  for (const FollowMode mode : kFollowModes) {
    const RigidTransform fixed_from_frame = random.transform(20.0);
    follow.setMode(mode, random.transform(20.0), rig);
    follow.track(fixed_from_frame, rig);
    const double radius_m = rig.model().sight().radius_m;
    follow.recenter(fixed_from_frame, rig);
    const auto at = toScreen(view(), kSize, fixed_from_frame.translation);
    ASSERT_TRUE(at) << toString(mode);
    EXPECT_NEAR(at->position_px.x, kSize.width_px / 2, 1e-6) << toString(mode);
    EXPECT_NEAR(at->position_px.y, kSize.height_px / 2, 1e-6) << toString(mode);
    EXPECT_NEAR(rig.model().sight().radius_m, radius_m, 1e-9) << toString(mode);
    EXPECT_EQ(follow.state().base_from_camera.rotation, glm::dquat(1, 0, 0, 0)) << "upright in the base";
  }
}

TEST_P(EveryCameraFollows, SavedStateComesBackBitForBit) {
  Random random(43);
  for (int i = 0; i < 100; ++i) {
    follow.setMode(kFollowModes[random.index(4)], random.transform(1e7), rig);
    follow.track(random.transform(1e7), rig);
    FollowState read;
    ASSERT_TRUE(applyFollowTexts(followTexts(follow.state()), read).has_value());
    Follow restored;
    restored.setState(read);
    EXPECT_EQ(restored.state(), follow.state());
    EXPECT_EQ(restored.view(rig.view()).eye_from_fixed, view().eye_from_fixed);
    const RigidTransform next = random.transform(100.0);
    CameraRig other = rig;
    follow.track(next, rig);
    restored.track(next, other);
    EXPECT_EQ(restored.view(other.view()).eye_from_fixed, view().eye_from_fixed) << "and goes on alike";
  }
}

TEST_P(EveryCameraFollows, ANewFixedFrameLeavesTheViewOfTheDataWhenBothStandUpright) {
  for (const FollowMode mode : kFollowModes) {
    const RigidTransform old_from_frame = turn(0.7, 4, 5, 0);
    follow.setMode(mode, old_from_frame, rig);
    const CameraView before = view();
    const RigidTransform place = seen();
    const RigidTransform new_from_old = turn(-1.3, 100, 50, 2);
    follow.changeFixedFrame(new_from_old, new_from_old * old_from_frame, rig);
    CameraView after = view();
    after.eye_from_fixed = after.eye_from_fixed * tf::toMatrix(new_from_old);
    EXPECT_LT(difference(before, after, place, 12.0), 1e-9) << toString(mode);
  }
}

std::string followKindName(const testing::TestParamInfo<CameraKind>& info) { return std::string(toString(info.param)); }

INSTANTIATE_TEST_SUITE_P(Camera, EveryCameraFollows, testing::ValuesIn(kCameraKinds), followKindName);

/// How far the picture turns between neighbouring attitudes of the followed frame, at most.
double largestTurn(Follow& follow, CameraRig& rig, const std::vector<glm::dquat>& attitudes) {
  double largest = 0.0;
  glm::dquat last = follow.fixedFromCamera().rotation;
  for (const glm::dquat& attitude : attitudes) {
    follow.track(RigidTransform{attitude, {}}, rig);
    const glm::dquat step = glm::conjugate(last) * follow.fixedFromCamera().rotation;
    largest = std::max(largest, 2.0 * std::atan2(glm::length(glm::dvec3(step.x, step.y, step.z)), std::abs(step.w)));
    last = follow.fixedFromCamera().rotation;
  }
  return largest;
}

TEST(FollowHeading, AFramePitchedThroughNinetyDegreesDoesNotFlipTheView) {
  for (const double yaw : {0.0, 0.9, -2.5}) {
    CameraRig rig;
    Follow follow;
    const glm::dquat level = about({0, 0, 1}, yaw);
    follow.setMode(FollowMode::Heading, RigidTransform{level, {}}, rig);
    std::vector<glm::dquat> attitudes;
    for (int degree = 0; degree <= 179; ++degree) {
      attitudes.push_back(level * about({0, 1, 0}, degree * kPi / 180.0));
    }
    EXPECT_LT(largestTurn(follow, rig, attitudes), 1e-9) << yaw;
  }
}

TEST(FollowHeading, AFrameMountedUpsideDownTurnsTheViewSmoothly) {
  CameraRig rig;
  Follow follow;
  const glm::dquat mounted = about({1, 0, 0}, kPi);
  follow.setMode(FollowMode::Heading, RigidTransform{mounted, {}}, rig);
  Random random(47);
  std::vector<glm::dquat> attitudes;
  for (int degree = 0; degree <= 720; ++degree) {  // of a robot that turns and sways a little
    attitudes.push_back(about({0, 0, 1}, degree * kPi / 180.0) * about({1, 0, 0}, random.number(-0.01, 0.01)) *
                        about({0, 1, 0}, random.number(-0.01, 0.01)) * mounted);
  }
  EXPECT_LT(largestTurn(follow, rig, attitudes), 1.1 * kPi / 180.0);
}

TEST(FollowHeading, GoesOnFromAFrameThatPointsStraightUp) {
  CameraRig rig;
  Follow follow;
  const glm::dquat up = about({0, 1, 0}, -kPi / 2.0);
  follow.setMode(FollowMode::Heading, RigidTransform{up, {}}, rig);
  std::vector<glm::dquat> attitudes;
  for (int degree = 0; degree <= 360; ++degree) {
    attitudes.push_back(about({0, 0, 1}, degree * kPi / 180.0) * up);
  }
  EXPECT_LT(largestTurn(follow, rig, attitudes), 1.1 * kPi / 180.0);
}

TEST(FollowTexts, RefusesWhatIsNoTransform) {
  FollowState state;
  EXPECT_FALSE(applyFollowTexts({{"mode", "sideways"}}, state).has_value());
  EXPECT_FALSE(applyFollowTexts({{"base_from_camera.x", "nan"}}, state).has_value());
  ASSERT_TRUE(applyFollowTexts({{"mode", "pose"}, {"base_from_camera.qw", "0"}}, state).has_value());
  Follow follow;
  follow.setState(state);
  EXPECT_EQ(follow.mode(), FollowMode::Off) << "a quaternion of zero is no rotation";
}

}  // namespace
}  // namespace stillframe::scenegraph
