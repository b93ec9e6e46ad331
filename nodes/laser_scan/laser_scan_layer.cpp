#include "nodes/laser_scan/laser_scan_layer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nodes/laser_scan/scan_cloud.h"
#include "scenegraph/objects/laser_scan.h"

namespace stillframe::nodes {
namespace {

using scenegraph::Status;
using scenegraph::StatusLevel;

std::expected<CloudPoints, Status> pointsOf(const scenegraph::AnyObject& object, const PointCloudSettings& settings) {
  auto scan = convertScan(*object.get<scenegraph::LaserScan>());
  if (!scan) {
    return std::unexpected(scan.error());
  }
  return CloudPoints::make(std::make_shared<const scenegraph::PointCloud>(std::move(scan->cloud)),
                           {.left_out = scan->dropped, .duration_s = scan->duration_s}, wantedChannel(settings));
}

CloudFeed scanFeed() {
  CloudFeed feed{.type = scenegraph::ObjectType::LaserScan,
                 .tag = "scan points",
                 .convert = &pointsOf,
                 .settle = {},
                 .defaults = {}};
  feed.defaults.point_size = 3.0;
  return feed;
}

const scenegraph::SettingsTable<LaserScanSettings>& scanTable() {
  using S = LaserScanSettings;
  using scenegraph::SettingKind;
  static const scenegraph::SettingsTable<S> kTable{
      {{.key = "deskew",
        .label = "De-skew",
        .help = "Moves each beam to where the sensor saw it, by time_increment and the sensor's motion.",
        .kind = SettingKind::Bool},
       &S::deskew},
      {{.key = "deskew_frame",
        .label = "Inertial frame",
        .help = "Ancestor of the scan's frame through which the sensor's motion is measured; auto takes odom, else the "
                "root.",
        .kind = SettingKind::Text,
        .choices = {"auto"}},
       &S::deskew_frame}};
  return kTable;
}

}  // namespace

std::unique_ptr<scenegraph::Layer> LaserScanLayer::create(std::string_view topic) {
  return std::make_unique<LaserScanLayer>(topic);
}

LaserScanLayer::LaserScanLayer(std::string_view topic) : PointCloudLayer(topic, scanFeed()) {}

void LaserScanLayer::forget() {
  inputs_.reset();
  plan_.reset();
  deskewed_ = nullptr;
  job_.reset();
  remark_ = {};
}

void LaserScanLayer::close() {
  PointCloudLayer::close();
  forget();
}

void LaserScanLayer::clear() {
  PointCloudLayer::clear();
  forget();
}

bool LaserScanLayer::isWorking() const { return PointCloudLayer::isWorking() || (job_ && job_->isPending()); }

std::optional<LaserScanLayer::Plan> LaserScanLayer::plan(const CloudPoints& loaded) {
  const double duration_s = loaded.supplement().duration_s;
  remark_ = {};
  if (!scan_settings_.deskew || duration_s == 0.0 || loaded.converted().points == 0) {
    return std::nullopt;
  }
  const auto refuse = [&](const std::string& why) {
    remark_ = {StatusLevel::Info, "NotDeskewed", loadedText() + "drawn without de-skewing: " + why};
    return std::nullopt;
  };
  if (std::abs(duration_s) > kLongestScan_s) {
    return refuse("its time_increment makes it take " + std::to_string(duration_s) + " s");
  }
  const bool is_log = context().dataset.tfClockInUse() == scenegraph::TfClock::Log;
  // Far from the ends of int64, so that no beam's time overflows.
  constexpr std::int64_t kFar_ns = std::int64_t{1} << 62;
  const std::int64_t stamp_ns = is_log ? loader().entry()->log_time.ns : loaded.source().stamp.ns;
  if (stamp_ns < -kFar_ns || stamp_ns > kFar_ns) {
    return refuse("its time is out of range");
  }
  const auto duration_ns = static_cast<std::int64_t>(std::llround(duration_s * 1e9));
  const std::int64_t first_ns = is_log ? stamp_ns - std::max<std::int64_t>(duration_ns, 0) : stamp_ns;
  const tf::TransformBuffer& buffer = *context().dataset.transforms();
  const std::string& sensor = loaded.source().frame_id;
  const std::string inertial =
      scan_settings_.deskew_frame == "auto" ? inertialFrame(buffer, sensor) : scan_settings_.deskew_frame;
  auto motion = SensorMotion::sample(buffer, inertial, sensor, {first_ns + std::min<std::int64_t>(duration_ns, 0)},
                                     {first_ns + std::max<std::int64_t>(duration_ns, 0)});
  if (!motion) {
    return refuse(motion.error().message);
  }
  if (motion->isStill()) {
    return std::nullopt;
  }
  return Plan{std::move(*motion), {first_ns}};
}

LaserScanLayer::Shown LaserScanLayer::drawnOf(const Shown& loaded) {
  if (loaded == nullptr) {
    forget();
    return nullptr;
  }
  // Read first: what arrives meanwhile makes the next tick differ.
  Inputs inputs{loaded, context().dataset.transforms()->revision(), scan_settings_};
  if (inputs_ != inputs) {
    const bool is_same_scan = inputs_ && inputs_->loaded == loaded;
    auto wanted = plan(*loaded);
    const bool is_same_plan = is_same_scan && wanted.has_value() == plan_.has_value() &&
                              (!wanted || (wanted->first_beam == plan_->first_beam && wanted->motion == plan_->motion));
    inputs_ = std::move(inputs);
    if (!is_same_plan) {
      plan_ = std::move(wanted);
      deskewed_ = nullptr;
      job_.reset();
      if (plan_) {
        job_.emplace(context().executor, context().request_update);
        job_->request({.payload_bytes = ++job_number_, .product = "deskewed"},
                      [loaded, plan = *plan_, settings = chosen()]() -> scenegraph::LatestJob<CloudPoints>::Result {
                        auto points = CloudPoints::make(std::make_shared<const scenegraph::PointCloud>(
                                                            deskew(loaded->source(), plan.motion, plan.first_beam)),
                                                        loaded->supplement(), wantedChannel(settings));
                        if (!points) {
                          return std::unexpected(points.error());
                        }
                        prepareColors(*points, chooseColor(settings.color_field, *points, *points), settings);
                        return std::make_shared<const CloudPoints>(std::move(*points));
                      });
      }
    }
  }
  if (!plan_) {
    return loaded;
  }
  if (deskewed_ == nullptr && job_) {
    if (auto outcome = job_->take()) {
      if (outcome->result) {
        deskewed_ = *outcome->result;
      } else {
        remark_ = outcome->result.error();
        plan_.reset();
        return loaded;
      }
    }
  }
  // While it is under way, what was drawn before stays.
  return deskewed_ != nullptr ? deskewed_ : product() != nullptr ? product() : loaded;
}

scenegraph::LayerCounts LaserScanLayer::counts() const {
  auto counts = PointCloudLayer::counts();
  const bool is_deskewed = product() != nullptr && product() == deskewed_;
  counts.emplace_back("deskewed", is_deskewed ? product()->converted().points : 0);
  return counts;
}

std::vector<scenegraph::SettingSpec> LaserScanLayer::settingSpecs() const {
  auto specs = PointCloudLayer::settingSpecs();
  std::ranges::move(scanTable().specs(), std::back_inserter(specs));
  return specs;
}

scenegraph::SettingTexts LaserScanLayer::settings() const {
  auto texts = PointCloudLayer::settings();
  texts.merge(scanTable().texts(scan_settings_));
  return texts;
}

std::expected<void, scenegraph::SettingError> LaserScanLayer::changeSettings(const scenegraph::SettingTexts& texts) {
  scenegraph::SettingTexts own;
  scenegraph::SettingTexts of_clouds;
  const auto defaults = scanTable().texts({});
  for (const auto& [key, text] : texts) {
    (defaults.contains(key) ? own : of_clouds)[key] = text;
  }
  LaserScanSettings changed = scan_settings_;
  if (auto applied = scanTable().apply(own, changed); !applied) {
    return applied;
  }
  if (auto applied = PointCloudLayer::changeSettings(of_clouds); !applied) {
    return applied;
  }
  scan_settings_ = std::move(changed);
  return {};
}

}  // namespace stillframe::nodes
