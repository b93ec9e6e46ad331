#include "tools/sample/robot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tools/sample/world.h"

namespace stillframe::sample {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

TEST(Robot, DrivesSmoothlyAtWalkingSpeed) {
  const Robot robot(1, 120 * kSecond);
  for (std::int64_t t = 0; t < 120 * kSecond; t += Robot::kStep_ns) {
    const Pose2 a = robot.truth(t);
    const Pose2 b = robot.truth(t + Robot::kStep_ns);
    const double speed = std::hypot(b.x - a.x, b.y - a.y) / 0.02;
    ASSERT_GT(speed, 0.5) << t;
    ASSERT_LT(speed, 1.3) << t;
    ASSERT_LT(std::abs(std::remainder(b.yaw_rad - a.yaw_rad, 2.0 * std::numbers::pi)), 0.02) << t;
  }
}

TEST(Robot, KeepsClearOfEverything) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const World world(seed);
    const Robot robot(seed, kSecond);
    for (std::int64_t t = 0; t < 70 * kSecond; t += kSecond / 2) {
      const Pose2 pose = robot.truth(t);
      const RayCaster caster(world, static_cast<double>(t) * 1e-9, {pose.x, pose.y, 0.5});
      for (int i = 0; i < 72; ++i) {
        const double azimuth = i * std::numbers::pi / 36.0;
        const auto hit = caster.cast({std::cos(azimuth), std::sin(azimuth), 0.0}, 100.0);
        ASSERT_TRUE(hit) << "seed " << seed << " inside something at " << pose.x << ", " << pose.y;
        ASSERT_GT(hit->range_m, 0.5) << "seed " << seed << " at " << pose.x << ", " << pose.y;
      }
    }
  }
}

TEST(Robot, DriftsInOdomAndIsCorrectedInMap) {
  const Robot robot(1, 60 * kSecond);
  double drift = 0.0;
  for (std::int64_t t = 0; t <= 60 * kSecond; t += Robot::kCorrection_ns) {
    const tf::RigidTransform map_from_base = robot.mapFromOdom(t) * robot.odomFromBase(t);
    const Pose2 truth = robot.truth(t);
    ASSERT_LT(glm::distance(map_from_base.translation, glm::dvec3(truth.x, truth.y, 0.0)), 0.02) << t;
    drift = std::max(drift, glm::distance(robot.mapFromOdom(t).translation, robot.mapFromOdom(0).translation));
  }
  EXPECT_GT(drift, 0.1);
}

TEST(Robot, TurnsItsWheelsForwardOverWholeLaps) {
  const Robot robot(1, kSecond);
  for (const int side : {-1, 1}) {
    for (std::int64_t t = 0; t < 150 * kSecond; t += kSecond / 10) {
      ASSERT_GT(robot.wheelAngle(side, t + kSecond / 10), robot.wheelAngle(side, t)) << side << ' ' << t;
    }
  }
}

}  // namespace
}  // namespace stillframe::sample
