#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "tools/sample/robot.h"
#include "tools/sample/ros2_messages.h"
#include "tools/sample/world.h"

namespace stillframe::sample {

/// What the producers of a recording look at. Outlives them.
struct Stage {
  const World& world;
  const Robot& robot;
  std::uint64_t seed = 1;
  std::int64_t start_ns = 0;  ///< stamp of the first samples
};

/// Makes the messages of one kind on one topic, at a fixed rate. One file each; add new ones to makeTopics().
class Topic {
 public:
  virtual ~Topic() = default;
  [[nodiscard]] virtual std::string_view name() const = 0;
  [[nodiscard]] virtual Ros2Type type() const = 0;
  /// Between messages; 0 for one message at the start.
  [[nodiscard]] virtual std::int64_t periodNs() const = 0;
  /// The serialised message of that instant.
  [[nodiscard]] virtual std::vector<std::byte> message(std::int64_t elapsed_ns) const = 0;
};

[[nodiscard]] std::unique_ptr<Topic> makeStaticTransforms(const Stage& stage);
[[nodiscard]] std::unique_ptr<Topic> makeOdometryTransforms(const Stage& stage);
[[nodiscard]] std::unique_ptr<Topic> makeLocalisationTransforms(const Stage& stage);
[[nodiscard]] std::unique_ptr<Topic> makeLidar(const Stage& stage, std::uint32_t points);
[[nodiscard]] std::unique_ptr<Topic> makeDepthCamera(const Stage& stage);
/// `format`: "cloudini" or "draco"; `points` of the lidar itself.
[[nodiscard]] std::unique_ptr<Topic> makeCompressedLidar(const Stage& stage, std::uint32_t points,
                                                         std::string_view format);
[[nodiscard]] std::unique_ptr<Topic> makeDepthImages(const Stage& stage);
[[nodiscard]] std::unique_ptr<Topic> makeDepthCameraInfo(const Stage& stage);
[[nodiscard]] std::unique_ptr<Topic> makeMarkers(const Stage& stage);
[[nodiscard]] std::unique_ptr<Topic> makeMap(const Stage& stage);
[[nodiscard]] std::unique_ptr<Topic> makeMapUpdates(const Stage& stage);
[[nodiscard]] std::unique_ptr<Topic> makeScanner(const Stage& stage);
[[nodiscard]] std::unique_ptr<Topic> makeHeightMap(const Stage& stage);
[[nodiscard]] std::unique_ptr<Topic> makeRobotDescription();
[[nodiscard]] std::unique_ptr<Topic> makeArmStates(const Stage& stage);
[[nodiscard]] std::unique_ptr<Topic> makeVoxels(const Stage& stage);
[[nodiscard]] std::unique_ptr<Topic> makeOdometry(const Stage& stage);
[[nodiscard]] std::unique_ptr<Topic> makePath(const Stage& stage);
[[nodiscard]] std::unique_ptr<Topic> makeParticles(const Stage& stage);
[[nodiscard]] std::unique_ptr<Topic> makeFootprint(const Stage& stage);

/// Where the sensors are mounted: /tf_static says the same.
[[nodiscard]] tf::RigidTransform baseFromLidar();
[[nodiscard]] tf::RigidTransform baseFromCamera();
[[nodiscard]] tf::RigidTransform baseFromRearCamera();
[[nodiscard]] tf::RigidTransform baseFromScanner();
/// The optical frame looks along +z with x right and y down.
[[nodiscard]] tf::RigidTransform cameraFromOptical();

}  // namespace stillframe::sample
