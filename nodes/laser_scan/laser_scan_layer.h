#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/laser_scan/sensor_motion.h"
#include "nodes/point_cloud/point_cloud_layer.h"
#include "scenegraph/latest_job.h"

namespace stillframe::nodes {

/// What scans have beyond clouds.
struct LaserScanSettings {
  bool deskew = true;
  std::string deskew_frame = "auto";

  friend bool operator==(const LaserScanSettings&, const LaserScanSettings&) = default;
};

/// One topic of laser scans as points (REQUIREMENTS C10), with all that the layer of clouds can do.
///
/// A scan of a moving sensor is de-skewed: beam i, measured i * time_increment after the first, is put where the sensor
/// of the first beam's time sees what it hit, by the sensor's motion through an inertial frame (SensorMotion). Beam 0
/// is at the header stamp; where log times rule the transforms the last beam is at the scan's log time, because a
/// driver sends a scan when it is complete. The inertial frame does not depend on the view's fixed frame, so neither
/// does the shape of the scan. The points hang beneath the source frame like any cloud. GUI thread.
class LaserScanLayer final : public PointCloudLayer {
 public:
  [[nodiscard]] static std::unique_ptr<scenegraph::Layer> create(std::string_view topic);

  explicit LaserScanLayer(std::string_view topic);
  /// The cloud's, "dropped" being beams without a return, and "deskewed": points that were moved.
  [[nodiscard]] scenegraph::LayerCounts counts() const override;
  [[nodiscard]] std::vector<scenegraph::SettingSpec> settingSpecs() const override;
  [[nodiscard]] scenegraph::SettingTexts settings() const override;

  /// A scan that claims to take longer is left as it is.
  static constexpr double kLongestScan_s = 10.0;

 private:
  std::expected<void, scenegraph::SettingError> changeSettings(const scenegraph::SettingTexts& texts) override;
  void close() override;
  void clear() override;
  [[nodiscard]] Shown drawnOf(const Shown& loaded) override;
  [[nodiscard]] scenegraph::Status feedRemark() const override { return remark_; }
  [[nodiscard]] bool isWorking() const override;

  /// All that the motion depends on.
  struct Inputs {
    std::shared_ptr<const CloudPoints> loaded;
    std::uint64_t transforms_revision = 0;
    LaserScanSettings settings;
    friend bool operator==(const Inputs&, const Inputs&) = default;
  };
  struct Plan {
    SensorMotion motion;
    tf::TimePoint first_beam;
  };
  void forget();
  [[nodiscard]] std::optional<Plan> plan(const CloudPoints& loaded);

  LaserScanSettings scan_settings_;
  std::optional<Inputs> inputs_;
  std::optional<Plan> plan_;                     // nullopt: drawn as loaded
  std::shared_ptr<const CloudPoints> deskewed_;  // by plan_; nullptr while under way
  std::uint64_t job_number_ = 0;
  scenegraph::Status remark_;
  std::optional<scenegraph::LatestJob<CloudPoints>> job_;
};

}  // namespace stillframe::nodes
