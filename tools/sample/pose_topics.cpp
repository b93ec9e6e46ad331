// Odometry with its covariance, the path that was driven, the localisation's particles, and the footprint.
#include <utility>

#include "tools/sample/pose_messages.h"
#include "tools/sample/random.h"
#include "tools/sample/topic.h"

namespace stillframe::sample {
namespace {

using scenegraph::PosesInFrame;
using scenegraph::PosesKind;

/// What the wheels say at 10 Hz; what they do not know grows with time, most along the way.
class OdometryMessages final : public Topic {
 public:
  explicit OdometryMessages(const Stage& stage) : stage_(stage) {}
  std::string_view name() const override { return "/odom"; }
  Ros2Type type() const override { return odometryType(); }
  std::int64_t periodNs() const override { return 100'000'000; }
  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    PosesInFrame odometry;
    odometry.stamp = {stage_.start_ns + elapsed_ns};
    odometry.frame_id = "odom";
    odometry.child_frame_id = "base_link";
    odometry.poses = {stage_.robot.odomFromBase(elapsed_ns)};
    const glm::dvec3 ahead = odometry.poses.front().rotation * glm::dvec3(1.0, 0.0, 0.0);
    const double seconds = static_cast<double>(elapsed_ns) * 1e-9;
    const double along = 0.01 + 0.004 * seconds;  // variances
    const double across = 0.005 + 0.0015 * seconds;
    auto& covariance = odometry.covariance.emplace();
    covariance[0] = along * ahead.x * ahead.x + across * ahead.y * ahead.y;
    covariance[7] = along * ahead.y * ahead.y + across * ahead.x * ahead.x;
    covariance[1] = covariance[6] = (along - across) * ahead.x * ahead.y;
    covariance[14] = covariance[21] = covariance[28] = 1e12;  // it drives on a plane: nothing is known of the rest
    covariance[35] = 0.002 + 0.0005 * seconds;
    return serializeOdometry(odometry);
  }

 private:
  Stage stage_;
};

/// Where the robot was so far, twice a second.
class PathMessages final : public Topic {
 public:
  explicit PathMessages(const Stage& stage) : stage_(stage) {}
  std::string_view name() const override { return "/path"; }
  Ros2Type type() const override { return pathType(); }
  std::int64_t periodNs() const override { return 500'000'000; }
  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    constexpr std::int64_t kBetween_ns = 200'000'000;
    PosesInFrame path;
    path.stamp = {stage_.start_ns + elapsed_ns};
    path.frame_id = "map";
    for (std::int64_t at = 0; at <= elapsed_ns; at += kBetween_ns) {
      path.poses.push_back(toRigid(stage_.robot.truth(at)));
      path.stamps.push_back({stage_.start_ns + at});
    }
    return serializePath(path);
  }

 private:
  Stage stage_;
};

/// Where a particle filter believes the robot to be: 200 guesses about the truth, twice a second.
class ParticleMessages final : public Topic {
 public:
  explicit ParticleMessages(const Stage& stage) : stage_(stage) {}
  std::string_view name() const override { return "/particles"; }
  Ros2Type type() const override { return poseArrayType(); }
  std::int64_t periodNs() const override { return Robot::kCorrection_ns; }
  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    constexpr int kParticles = 200;
    const Pose2 truth = stage_.robot.truth(elapsed_ns);
    Random random(stage_.seed ^ static_cast<std::uint64_t>(elapsed_ns));
    PosesInFrame particles;
    particles.stamp = {stage_.start_ns + elapsed_ns};
    particles.frame_id = "map";
    for (int i = 0; i < kParticles; ++i) {
      particles.poses.push_back(toRigid({.x = truth.x + 0.2 * random.gaussian(),
                                         .y = truth.y + 0.2 * random.gaussian(),
                                         .yaw_rad = truth.yaw_rad + 0.1 * random.gaussian()}));
    }
    return serializePoseArray(particles);
  }

 private:
  Stage stage_;
};

/// The outline of the robot on the floor, once.
class FootprintMessages final : public Topic {
 public:
  explicit FootprintMessages(const Stage& stage) : stage_(stage) {}
  std::string_view name() const override { return "/footprint"; }
  Ros2Type type() const override { return polygonStampedType(); }
  std::int64_t periodNs() const override { return 0; }
  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    PosesInFrame footprint;
    footprint.stamp = {stage_.start_ns + elapsed_ns};
    footprint.frame_id = "base_link";
    for (const auto& [x, y] :
         {std::pair{0.45, -0.2}, {0.45, 0.2}, {0.3, 0.35}, {-0.45, 0.35}, {-0.45, -0.35}, {0.3, -0.35}}) {
      footprint.poses.push_back({.translation = {x, y, 0.0}});
    }
    return serializePolygonStamped(footprint);
  }

 private:
  Stage stage_;
};

}  // namespace

std::unique_ptr<Topic> makeOdometry(const Stage& stage) { return std::make_unique<OdometryMessages>(stage); }
std::unique_ptr<Topic> makePath(const Stage& stage) { return std::make_unique<PathMessages>(stage); }
std::unique_ptr<Topic> makeParticles(const Stage& stage) { return std::make_unique<ParticleMessages>(stage); }
std::unique_ptr<Topic> makeFootprint(const Stage& stage) { return std::make_unique<FootprintMessages>(stage); }

}  // namespace stillframe::sample
