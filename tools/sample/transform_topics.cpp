#include <array>
#include <cmath>

#include "tools/sample/topic.h"

namespace stillframe::sample {
namespace {

using scenegraph::FrameTransform;

tf::RigidTransform wheel(int side, double angle_rad) {
  return {{std::cos(0.5 * angle_rad), 0.0, std::sin(0.5 * angle_rad), 0.0},
          {0.0, side * -0.5 * Robot::kTrack_m, Robot::kWheelRadius_m}};
}

/// The mounts of the sensors, once, latched.
class StaticTransforms final : public Topic {
 public:
  explicit StaticTransforms(const Stage& stage) : stage_(stage) {}
  std::string_view name() const override { return "/tf_static"; }
  Ros2Type type() const override { return tfMessageType(); }
  std::int64_t periodNs() const override { return 0; }
  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    const tf::TimePoint stamp{stage_.start_ns + elapsed_ns};
    const std::array transforms{
        FrameTransform{stamp, "base_link", "lidar_link", baseFromLidar()},
        FrameTransform{stamp, "base_link", "camera_link", baseFromCamera()},
        FrameTransform{stamp, "camera_link", "camera_optical_frame", cameraFromOptical()},
        FrameTransform{stamp, "base_link", "rear_camera_link", baseFromRearCamera()},
        FrameTransform{stamp, "rear_camera_link", "rear_camera_optical_frame", cameraFromOptical()},
        FrameTransform{stamp, "base_link", "scan_link", baseFromScanner()},
    };
    return serializeTfMessage(transforms);
  }

 private:
  Stage stage_;
};

/// odom -> base_link and the turning wheels, 50 Hz.
class OdometryTransforms final : public Topic {
 public:
  explicit OdometryTransforms(const Stage& stage) : stage_(stage) {}
  std::string_view name() const override { return "/tf"; }
  Ros2Type type() const override { return tfMessageType(); }
  std::int64_t periodNs() const override { return Robot::kStep_ns; }
  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    const tf::TimePoint stamp{stage_.start_ns + elapsed_ns};
    const Robot& robot = stage_.robot;
    const std::array transforms{
        FrameTransform{stamp, "odom", "base_link", robot.odomFromBase(elapsed_ns)},
        FrameTransform{stamp, "base_link", "left_wheel", wheel(-1, robot.wheelAngle(-1, elapsed_ns))},
        FrameTransform{stamp, "base_link", "right_wheel", wheel(1, robot.wheelAngle(1, elapsed_ns))},
    };
    return serializeTfMessage(transforms);
  }

 private:
  Stage stage_;
};

/// map -> odom, corrected twice a second.
class LocalisationTransforms final : public Topic {
 public:
  explicit LocalisationTransforms(const Stage& stage) : stage_(stage) {}
  std::string_view name() const override { return "/tf"; }
  Ros2Type type() const override { return tfMessageType(); }
  std::int64_t periodNs() const override { return Robot::kCorrection_ns; }
  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    const std::array transforms{
        FrameTransform{{stage_.start_ns + elapsed_ns}, "map", "odom", stage_.robot.mapFromOdom(elapsed_ns)}};
    return serializeTfMessage(transforms);
  }

 private:
  Stage stage_;
};

}  // namespace

tf::RigidTransform baseFromLidar() { return {{1.0, 0.0, 0.0, 0.0}, {0.05, 0.0, 0.95}}; }

tf::RigidTransform baseFromScanner() { return {{1.0, 0.0, 0.0, 0.0}, {0.3, 0.0, 0.25}}; }

tf::RigidTransform baseFromCamera() {
  constexpr double kPitchDown = 0.09;
  return {{std::cos(0.5 * kPitchDown), 0.0, std::sin(0.5 * kPitchDown), 0.0}, {0.32, 0.0, 0.6}};
}

tf::RigidTransform baseFromRearCamera() {
  constexpr double kPitchDown = 0.2;  // after half a turn about z
  return {{0.0, -std::sin(0.5 * kPitchDown), 0.0, std::cos(0.5 * kPitchDown)}, {-0.32, 0.0, 0.7}};
}

tf::RigidTransform cameraFromOptical() { return {{0.5, -0.5, 0.5, -0.5}, {0.0, 0.0, 0.0}}; }

std::unique_ptr<Topic> makeStaticTransforms(const Stage& stage) { return std::make_unique<StaticTransforms>(stage); }
std::unique_ptr<Topic> makeOdometryTransforms(const Stage& stage) {
  return std::make_unique<OdometryTransforms>(stage);
}
std::unique_ptr<Topic> makeLocalisationTransforms(const Stage& stage) {
  return std::make_unique<LocalisationTransforms>(stage);
}

}  // namespace stillframe::sample
