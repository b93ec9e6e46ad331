#pragma once

#include <cstdint>
#include <vector>

#include "tf/rigid_transform.h"

namespace stillframe::sample {

/// Place of the robot on the floor.
struct Pose2 {
  double x = 0.0;
  double y = 0.0;
  double yaw_rad = 0.0;
};
[[nodiscard]] tf::RigidTransform toRigid(const Pose2& pose);

/// A differential-drive robot on a smooth closed loop round the middle racks: where it is, and where it believes to be.
///
/// Odometry is what its wheels tell, with a scale error and noise, so that odom drifts; map_from_odom makes good for
/// it twice a second. All of it is a function of (seed, time). Immutable once made; memory is 24 bytes a step.
class Robot {
 public:
  static constexpr std::int64_t kStep_ns = 20'000'000;         ///< of odometry
  static constexpr std::int64_t kCorrection_ns = 500'000'000;  ///< between corrections of map_from_odom
  static constexpr double kWheelRadius_m = 0.15;
  static constexpr double kTrack_m = 0.52;

  Robot(std::uint64_t seed, std::int64_t duration_ns);

  /// Where it truly is, `elapsed_ns` after the start: 0.9 m/s on average.
  [[nodiscard]] Pose2 truth(std::int64_t elapsed_ns) const;
  [[nodiscard]] tf::RigidTransform odomFromBase(std::int64_t elapsed_ns) const;
  /// Of the localisation, at that very moment: a few millimetres from the truth.
  [[nodiscard]] tf::RigidTransform mapFromOdom(std::int64_t elapsed_ns) const;
  /// How far the left (-1) or right (+1) wheel has turned.
  [[nodiscard]] double wheelAngle(int side, std::int64_t elapsed_ns) const;

 private:
  [[nodiscard]] double distance(std::int64_t elapsed_ns) const;

  std::uint64_t seed_;
  double phase_;
  std::vector<double> arc_m_;  // length of the loop up to parameter 2 pi i / (size - 1)
  std::vector<Pose2> odom_;    // by step
};

}  // namespace stillframe::sample
