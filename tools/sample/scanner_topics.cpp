#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "tools/sample/random.h"
#include "tools/sample/scan_messages.h"
#include "tools/sample/topic.h"

namespace stillframe::sample {
namespace {

constexpr double kRangeNoise_m = 0.002;

/// A planar scanner at 5 Hz, one turn in 0.1 s, not mended for the robot's motion: beam i is measured i *
/// time_increment after the stamp. What lies nearer than 0.2 m or beyond 12 m is no return. The first scan is taken in
/// an instant, before the robot starts.
class Scanner final : public Topic {
 public:
  explicit Scanner(const Stage& stage) : stage_(stage) {}
  std::string_view name() const override { return "/scan"; }
  Ros2Type type() const override { return laserScanType(); }
  std::int64_t periodNs() const override { return 200'000'000; }

  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    constexpr std::int64_t kTurn_ns = 100'000'000;
    const std::int64_t first_ns = std::max<std::int64_t>(0, elapsed_ns - kTurn_ns);
    scenegraph::LaserScan scan;
    scan.stamp = {stage_.start_ns + first_ns};
    scan.frame_id = "scan_link";
    // As FLOAT32, which is what the message holds and readers go by.
    scan.angle_min_rad = static_cast<float>(-std::numbers::pi);
    scan.angle_increment_rad = static_cast<float>(2.0 * std::numbers::pi / kBeams);
    scan.time_increment_s = elapsed_ns == 0 ? 0.0 : static_cast<float>(1e-9 * kTurn_ns / kBeams);
    scan.range_min_m = 0.2;
    scan.range_max_m = 12.0;
    Random random(stage_.seed ^ static_cast<std::uint64_t>(elapsed_ns + 7) * 0xA0761D6478BD642FULL);
    for (std::uint32_t group = 0; group < kBeams / kGroup; ++group) {
      castGroup(group * kGroup, first_ns, random, scan);
    }
    return serializeLaserScan(scan);
  }

 private:
  static constexpr std::uint32_t kBeams = 720;
  static constexpr std::uint32_t kGroup = 20;  // beams that leave from one place: 2.5 mm of the robot's way

  void castGroup(std::uint32_t begin, std::int64_t first_ns, Random& random, scenegraph::LaserScan& scan) const {
    const auto after = [&](double beam) { return first_ns + std::llround(beam * scan.time_increment_s * 1e9); };
    const std::int64_t middle_ns = after(begin + 0.5 * (kGroup - 1));
    const tf::RigidTransform middle = toRigid(stage_.robot.truth(middle_ns)) * baseFromScanner();
    const RayCaster caster(stage_.world, static_cast<double>(middle_ns) * 1e-9, middle.translation);
    for (std::uint32_t i = begin; i < begin + kGroup; ++i) {
      const tf::RigidTransform map_from_scanner = toRigid(stage_.robot.truth(after(i))) * baseFromScanner();
      const double angle = scan.angle_min_rad + i * scan.angle_increment_rad;
      const glm::dvec3 direction = map_from_scanner.rotation * glm::dvec3(std::cos(angle), std::sin(angle), 0.0);
      const auto hit = caster.cast(direction, 100.0);
      // The way between the two places along the beam.
      const double ahead = glm::dot(middle.translation - map_from_scanner.translation, direction);
      scan.ranges_m.push_back(hit ? hit->range_m + ahead + kRangeNoise_m * random.gaussian()
                                  : std::numeric_limits<double>::infinity());
      const double incidence = hit ? std::abs(glm::dot(direction, hit->normal_in_map)) : 0.0;
      scan.intensities.push_back(hit ? 255.0 * appearance(hit->material).reflectivity * incidence : 0.0);
    }
  }

  Stage stage_;
};

/// What stands in the greater half of the warehouse, once, as a map of heights: no data west of x = -2 m and where it
/// reaches above 3 m. A second layer is the reflectivity of the top.
class HeightMap final : public Topic {
 public:
  explicit HeightMap(const Stage& stage) : stage_(stage) {}
  std::string_view name() const override { return "/elevation_map"; }
  Ros2Type type() const override { return gridMapType(); }
  std::int64_t periodNs() const override { return 0; }

  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    constexpr std::uint32_t kRows = 140;
    constexpr std::uint32_t kColumns = 90;
    constexpr double kCell_m = 0.2;
    constexpr double kHighest_m = 3.0;
    constexpr double kWest_m = -2.0;
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    MapMessage map{.stamp_ns = stage_.start_ns + elapsed_ns,
                   .frame_id = "map",
                   .resolution_m = kCell_m,
                   .rows = kRows,
                   .columns = kColumns,
                   .layers = {{"elevation", {}}, {"reflectivity", {}}}};
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      for (std::uint32_t row = 0; row < kRows; ++row) {
        const double x = (0.5 * kRows - 0.5 - row) * kCell_m;
        const double y = (0.5 * kColumns - 0.5 - column) * kCell_m;
        const Top top = stage_.world.topAt(x, y);
        const bool is_known = top.height_m <= kHighest_m && x > kWest_m;
        map.layers[0].values.push_back(is_known ? static_cast<float>(top.height_m) : kNan);
        map.layers[1].values.push_back(is_known ? appearance(top.material).reflectivity : kNan);
      }
    }
    return serializeGridMap(map);
  }

 private:
  Stage stage_;
};

}  // namespace

std::unique_ptr<Topic> makeScanner(const Stage& stage) { return std::make_unique<Scanner>(stage); }
std::unique_ptr<Topic> makeHeightMap(const Stage& stage) { return std::make_unique<HeightMap>(stage); }

}  // namespace stillframe::sample
