#include "tools/sample/robot.h"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <numbers>

#include "tools/sample/random.h"

namespace stillframe::sample {
namespace {

constexpr std::size_t kArcSteps = 4096;
constexpr double kTurn = 2.0 * std::numbers::pi;

/// The loop: an ellipse a little out of round.
glm::dvec2 loopPoint(double u) {
  return {11.2 * std::cos(u) + 0.25 * std::sin(2.0 * u), 6.1 * std::sin(u) + 0.3 * std::sin(3.0 * u)};
}

glm::dvec2 loopTangent(double u) {
  return {-11.2 * std::sin(u) + 0.5 * std::cos(2.0 * u), 6.1 * std::cos(u) + 0.9 * std::cos(3.0 * u)};
}

Pose2 compose(const Pose2& a, const Pose2& b) {
  const double c = std::cos(a.yaw_rad);
  const double s = std::sin(a.yaw_rad);
  return {a.x + c * b.x - s * b.y, a.y + s * b.x + c * b.y, a.yaw_rad + b.yaw_rad};
}

Pose2 inverse(const Pose2& a) {
  const double c = std::cos(a.yaw_rad);
  const double s = std::sin(a.yaw_rad);
  return {-c * a.x - s * a.y, s * a.x - c * a.y, -a.yaw_rad};
}

}  // namespace

tf::RigidTransform toRigid(const Pose2& pose) {
  return {{std::cos(0.5 * pose.yaw_rad), 0.0, 0.0, std::sin(0.5 * pose.yaw_rad)}, {pose.x, pose.y, 0.0}};
}

Robot::Robot(std::uint64_t seed, std::int64_t duration_ns) : seed_(seed) {
  Random random(seed ^ 0x0D0ULL);
  phase_ = random.uniform(0.0, kTurn);
  arc_m_.reserve(kArcSteps + 1);
  arc_m_.push_back(0.0);
  for (std::size_t i = 0; i < kArcSteps; ++i) {
    const double u = kTurn * (static_cast<double>(i) + 0.5) / kArcSteps;
    const glm::dvec2 tangent = loopTangent(u);
    arc_m_.push_back(arc_m_.back() + std::hypot(tangent.x, tangent.y) * kTurn / kArcSteps);
  }

  const std::int64_t steps = duration_ns / kStep_ns;
  odom_.reserve(static_cast<std::size_t>(steps) + 1);
  odom_.push_back({});
  Pose2 before = truth(0);
  for (std::int64_t step = 1; step <= steps; ++step) {
    const Pose2 after = truth(step * kStep_ns);
    Pose2 moved = compose(inverse(before), after);
    moved.yaw_rad = std::remainder(moved.yaw_rad, kTurn);
    const double length = std::hypot(moved.x, moved.y);
    const double scale = 1.012 + 0.02 * random.gaussian();
    moved = {moved.x * scale, moved.y * scale, moved.yaw_rad + length * (0.008 + 0.02 * random.gaussian())};
    odom_.push_back(compose(odom_.back(), moved));
    before = after;
  }
}

double Robot::distance(std::int64_t elapsed_ns) const {
  const double t = static_cast<double>(elapsed_ns) * 1e-9;
  return 0.9 * t + 0.6 * (1.0 - std::cos(0.4 * t));
}

Pose2 Robot::truth(std::int64_t elapsed_ns) const {
  const double length = arc_m_.back();
  const double along = std::fmod(distance(elapsed_ns) + phase_ / kTurn * length, length);
  const auto upper = std::ranges::upper_bound(arc_m_, along);
  const auto index = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(upper - arc_m_.begin(), 1, static_cast<std::ptrdiff_t>(arc_m_.size()) - 1));
  const double fraction = (along - arc_m_[index - 1]) / (arc_m_[index] - arc_m_[index - 1]);
  const double u = kTurn * (static_cast<double>(index - 1) + fraction) / kArcSteps;
  const glm::dvec2 point = loopPoint(u);
  const glm::dvec2 tangent = loopTangent(u);
  return {point.x, point.y, std::atan2(tangent.y, tangent.x)};
}

tf::RigidTransform Robot::odomFromBase(std::int64_t elapsed_ns) const {
  return toRigid(odom_[std::min(static_cast<std::size_t>(elapsed_ns / kStep_ns), odom_.size() - 1)]);
}

tf::RigidTransform Robot::mapFromOdom(std::int64_t elapsed_ns) const {
  const auto step = static_cast<std::uint64_t>(elapsed_ns / kStep_ns);
  Random random(seed_ ^ (step + 1) * 0xA0761D6478BD642FULL);
  const Pose2 estimate =
      compose(truth(elapsed_ns), {0.003 * random.gaussian(), 0.003 * random.gaussian(), 0.0005 * random.gaussian()});
  return toRigid(compose(estimate, inverse(odom_[std::min<std::size_t>(step, odom_.size() - 1)])));
}

double Robot::wheelAngle(int side, std::int64_t elapsed_ns) const {
  // The heading gained over whole laps counts too, so that a wheel never turns back at the end of one.
  double gained = std::remainder(truth(elapsed_ns).yaw_rad - truth(0).yaw_rad, kTurn);
  const double expected = distance(elapsed_ns) / arc_m_.back() * kTurn;
  gained += kTurn * std::round((expected - gained) / kTurn);
  return (distance(elapsed_ns) + side * 0.5 * kTrack_m * gained) / kWheelRadius_m;
}

}  // namespace stillframe::sample
