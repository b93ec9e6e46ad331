#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "nodes/laser_scan/scan_cloud.h"
#include "nodes/laser_scan/sensor_motion.h"
#include "scenegraph/objects/laser_scan.h"
#include "tests/support/builders.h"

namespace stillframe::test {
namespace {

using scenegraph::LaserScan;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kWall_m = 5.0;

LaserScan scanOf(std::vector<double> ranges) {
  LaserScan scan;
  scan.frame_id = "laser";
  scan.angle_increment_rad = std::numbers::pi / 2;
  scan.time_increment_s = 0.25;
  scan.range_min_m = 0.5;
  scan.range_max_m = 10.0;
  scan.ranges_m = std::move(ranges);
  return scan;
}

glm::dvec3 pointOf(const scenegraph::PointCloud& cloud, std::size_t i) {
  float xyz[3];
  std::memcpy(xyz, cloud.data.bytes.data() + i * cloud.point_step, sizeof xyz);
  return {xyz[0], xyz[1], xyz[2]};
}

std::vector<std::string> fieldNames(const scenegraph::PointCloud& cloud) {
  std::vector<std::string> names;
  for (const auto& field : cloud.fields) {
    names.push_back(field.name);
  }
  return names;
}

TEST(ScanCloud, KeepsReturnsAndTheirTimes) {
  LaserScan scan = scanOf({1.0, 2.0, 3.0});
  scan.intensities = {10, 20, 30};
  const auto result = nodes::convertScan(scan);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->dropped, 0U);
  EXPECT_EQ(result->duration_s, 0.5);
  EXPECT_THAT(fieldNames(result->cloud), ElementsAre("x", "y", "z", "intensity", "range", "t"));
  EXPECT_NEAR(glm::length(pointOf(result->cloud, 1) - glm::dvec3(0, 2, 0)), 0.0, 1e-6);
  EXPECT_NEAR(glm::length(pointOf(result->cloud, 2) - glm::dvec3(-3, 0, 0)), 0.0, 1e-6);
}

TEST(ScanCloud, DropsAndCountsWhatIsNoReturn) {
  const auto result = nodes::convertScan(scanOf({kNan, 0.5, 0.49, 10.0, 10.01, kInfinity, -kInfinity, -1.0}));
  ASSERT_TRUE(result);
  EXPECT_EQ(result->cloud.width, 2U) << "both limits belong to the range";
  EXPECT_EQ(result->dropped, 6U);
  double t = 0.0;
  std::memcpy(&t, result->cloud.data.bytes.data() + result->cloud.point_step + 24, sizeof t);
  EXPECT_EQ(t, 0.75) << "times are those of the beam, not of the point";
}

TEST(ScanCloud, WithoutAnUpperLimitOnlyInfinitiesAreDropped) {
  LaserScan scan = scanOf({1e6, kInfinity});
  scan.range_max_m = kInfinity;
  EXPECT_EQ(nodes::convertScan(scan)->cloud.width, 1U);
  scan.range_min_m = scan.range_max_m = kNan;
  EXPECT_EQ(nodes::convertScan(scan)->cloud.width, 1U);
}

TEST(ScanCloud, PutsEachBeamWhereItsAngleSays) {
  Random random(3);
  for (const double increment : {0.0, 1e-4, -0.017, 1.0, 700.0}) {
    LaserScan scan = scanOf({});
    scan.angle_min_rad = -2.2;
    scan.angle_increment_rad = increment;
    for (int i = 0; i < 1000; ++i) {
      scan.ranges_m.push_back(i % 7 == 0 ? kNan : random.number(0.5, 10.0));
    }
    const auto result = nodes::convertScan(scan);
    ASSERT_TRUE(result);
    std::size_t point = 0;
    for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
      if (const double range = scan.ranges_m[beam]; !std::isnan(range)) {
        const double angle = scan.angle_min_rad + static_cast<double>(beam) * increment;
        const glm::dvec3 expected(range * std::cos(angle), range * std::sin(angle), 0.0);
        ASSERT_LT(glm::length(pointOf(result->cloud, point++) - expected), 1e-6) << increment << ", beam " << beam;
      }
    }
    EXPECT_EQ(point, result->cloud.width);
  }
}

TEST(ScanCloud, LeavesOutIntensitiesOfAnotherCount) {
  LaserScan scan = scanOf({1, 2, 3});
  scan.intensities = {1, 2};
  EXPECT_THAT(fieldNames(nodes::convertScan(scan)->cloud), ElementsAre("x", "y", "z", "range", "t"));
  EXPECT_TRUE(nodes::convertScan(scanOf({})));
}

TEST(ScanCloud, RefusesNumbersThatMakeNoSense) {
  const auto codeOf = [](const LaserScan& scan) {
    const auto result = nodes::convertScan(scan);
    return result ? std::string("Ok") : result.error().code;
  };
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    LaserScan scan = scanOf({1, 2});
    scan.angle_min_rad = bad;
    EXPECT_EQ(codeOf(scan), "MalformedScan");
    scan = scanOf({1, 2});
    scan.angle_increment_rad = bad;
    EXPECT_EQ(codeOf(scan), "MalformedScan");
    scan = scanOf({1, 2});
    scan.time_increment_s = bad;
    EXPECT_EQ(codeOf(scan), "MalformedScan");
    scan = scanOf({1, 2});
    scan.pose.translation.x = bad;
    EXPECT_EQ(codeOf(scan), "MalformedScan");
  }
  LaserScan scan = scanOf({1, 2, 3});
  scan.angle_increment_rad = 1e308;
  scan.time_increment_s = 1e308;
  EXPECT_EQ(codeOf(scan), "MalformedScan");
}

/// A sensor that drives and turns before a wall at x = kWall_m of odom, 0.3 m ahead of its base.
struct Drive {
  double speed_m_s = 1.0;
  double rate_rad_s = 1.5;

  [[nodiscard]] tf::RigidTransform odomFromBase(std::int64_t ns) const {
    const double s = static_cast<double>(ns) * 1e-9;
    const double yaw = rate_rad_s * s;
    return turn(yaw, speed_m_s / rate_rad_s * std::sin(yaw), speed_m_s / rate_rad_s * (1.0 - std::cos(yaw)));
  }
  [[nodiscard]] std::shared_ptr<tf::TransformBuffer> buffer(std::int64_t period_ns) const {
    TfBuilder builder;
    builder.edge("map", "odom").at(0, turn(0.5, 1000, 2000)).at(120_ms, turn(0.6, 1003, 1999));
    builder.edge("base", "laser", true).at(0, translate(0.3, 0, 0.2)).edge("odom", "base");
    for (std::int64_t ns = 0; ns <= 1_s; ns += period_ns) {
      builder.at(ns, odomFromBase(ns));
    }
    return builder.build();
  }
  /// 180 beams over 90 degrees ahead, in 0.1 s from `first`.
  [[nodiscard]] LaserScan scan(std::int64_t first) const {
    LaserScan scan = scanOf({});
    scan.stamp = {first};
    scan.angle_min_rad = -std::numbers::pi / 4;
    scan.angle_increment_rad = std::numbers::pi / 360;
    scan.time_increment_s = 0.1 / 180;
    scan.range_max_m = 100.0;
    for (int i = 0; i < 180; ++i) {
      const auto odom_from_laser =
          odomFromBase(first + std::llround(i * scan.time_increment_s * 1e9)) * translate(0.3, 0, 0.2);
      const double angle = scan.angle_min_rad + i * scan.angle_increment_rad;
      const glm::dvec3 along = odom_from_laser.rotation * glm::dvec3(std::cos(angle), std::sin(angle), 0);
      scan.ranges_m.push_back(along.x > 0.05 ? (kWall_m - odom_from_laser.translation.x) / along.x : kNan);
    }
    return scan;
  }
};

/// How far the points lie off the wall at most, seen from the sensor's place of the first beam.
double worstOff(const scenegraph::PointCloud& cloud, const tf::RigidTransform& odom_from_laser) {
  double worst = 0.0;
  for (std::size_t i = 0; i < cloud.width; ++i) {
    worst = std::max(worst, std::abs(tf::transformPoint(odom_from_laser, pointOf(cloud, i)).x - kWall_m));
  }
  return worst;
}

TEST(Deskew, MakesAWallFlatWithinACentimetreAtUsualTransformRates) {
  const Drive drive;
  const std::int64_t first = 105_ms;  // between two samples of every rate
  const auto scan = nodes::convertScan(drive.scan(first));
  ASSERT_TRUE(scan);
  const auto odom_from_laser = drive.odomFromBase(first) * translate(0.3, 0, 0.2);
  EXPECT_GT(worstOff(scan->cloud, odom_from_laser), 0.5) << "nothing to mend";
  for (const auto& [period_ns, bound_m] : {std::pair{1_ms, 1e-4}, {10_ms, 1e-3}, {20_ms, 1e-3}, {50_ms, 1e-3}}) {
    const auto buffer = drive.buffer(period_ns);
    EXPECT_EQ(nodes::inertialFrame(*buffer, "/laser"), "odom");
    const auto motion = nodes::SensorMotion::sample(*buffer, "odom", "laser", {first}, {first + 100_ms});
    ASSERT_TRUE(motion) << motion.error().message;
    const auto mended = nodes::deskew(scan->cloud, *motion, {first});
    const double off_m = worstOff(mended, odom_from_laser);
    EXPECT_LT(off_m, bound_m) << "transforms every " << period_ns << " ns";
    RecordProperty("off_um_at_" + std::to_string(period_ns / 1'000'000) + "_ms", static_cast<int>(off_m * 1e6));
  }
}

TEST(Deskew, HeldTransformsWouldLeaveSteps) {
  // What the note beside SensorMotion says: the same with the tree's own lookups.
  const Drive drive;
  const auto buffer = drive.buffer(20_ms);
  const auto scan = nodes::convertScan(drive.scan(105_ms));
  double worst = 0.0;
  for (std::size_t i = 0; i < scan->cloud.width; ++i) {
    double t = 0.0;
    std::memcpy(&t, scan->cloud.data.bytes.data() + i * scan->cloud.point_step + 24, sizeof t);
    const auto held = buffer->lookupTransform("odom", "laser", {105_ms + std::llround(t * 1e9)});
    worst = std::max(worst, std::abs(tf::transformPoint(held, pointOf(scan->cloud, i)).x - kWall_m));
  }
  RecordProperty("held_off_um", static_cast<int>(worst * 1e6));
  EXPECT_GT(worst, 0.05);
}

TEST(Deskew, GoesBackwardsInTimeToo) {
  Drive drive;
  LaserScan scan = drive.scan(300_ms);
  std::ranges::reverse(scan.ranges_m);
  scan.angle_min_rad += 179 * scan.angle_increment_rad;
  scan.angle_increment_rad = -scan.angle_increment_rad;
  scan.time_increment_s = -scan.time_increment_s;
  const std::int64_t first = 300_ms + std::llround(-179 * scan.time_increment_s * 1e9);
  const auto motion = nodes::SensorMotion::sample(*drive.buffer(10_ms), "odom", "laser", {300_ms}, {first});
  const auto cloud = nodes::deskew(nodes::convertScan(scan)->cloud, *motion, {first});
  EXPECT_LT(worstOff(cloud, drive.odomFromBase(first) * translate(0.3, 0, 0.2)), 1e-3);
}

TEST(SensorMotion, IsStillWhereNothingMoves) {
  const auto buffer = TfBuilder()
                          .edge("odom", "base")
                          .at(0, turn(1.0))
                          .at(1_s, turn(1.0))
                          .at(2_s, turn(1.5))
                          .edge("base", "laser", true)
                          .at(0, translate(1, 0, 0))
                          .build();
  EXPECT_TRUE(nodes::SensorMotion::sample(*buffer, "odom", "laser", {0}, {900_ms})->isStill());
  EXPECT_FALSE(nodes::SensorMotion::sample(*buffer, "odom", "laser", {0}, {1100_ms})->isStill());
  EXPECT_TRUE(nodes::SensorMotion::sample(*buffer, "base", "laser", {0}, {2_s})->isStill());
  EXPECT_TRUE(nodes::SensorMotion::sample(*buffer, "odom", "laser", {5_s}, {6_s})->isStill())
      << "past the last it holds";
}

TEST(SensorMotion, TakesEverySampleOfTheSpanAndBoundsThem) {
  TfBuilder builder;
  builder.edge("odom", "laser");
  for (std::int64_t i = 0; i < 100'000; ++i) {
    builder.at(i * 100_us, translate(static_cast<double>(i * i), 0, 0));
  }
  const auto buffer = builder.build();
  const auto dense = nodes::SensorMotion::sample(*buffer, "odom", "laser", {5_s + 50_us}, {5_s + 10_ms});
  for (std::int64_t i = 50'001; i < 50'100; ++i) {
    EXPECT_EQ(dense->at({i * 100_us}).translation.x, static_cast<double>(i * i));
  }
  const auto bounded = nodes::SensorMotion::sample(*buffer, "odom", "laser", {0}, {9_s});
  const double true_x = 45'000.0 * 45'000.0;
  EXPECT_NEAR(bounded->at({4500_ms}).translation.x, true_x, 1e-5 * true_x);
}

TEST(SensorMotion, SaysWhyThereIsNone) {
  const auto buffer = TfBuilder()
                          .edge("odom", "laser")
                          .at(5_s, turn(0))
                          .edge("a", "b")
                          .at(0, turn(0))
                          .edge("map", "odom")
                          .at(0, turn(0))
                          .build();
  const auto messageOf = [&](const char* inertial, const char* sensor, std::int64_t time_ns) {
    const auto motion = nodes::SensorMotion::sample(*buffer, inertial, sensor, {time_ns}, {time_ns + 100_ms});
    return motion ? std::string("Ok") : motion.error().message;
  };
  EXPECT_THAT(messageOf("odom", "laser", 4_s), HasSubstr("no sample at or before 4.0"));
  EXPECT_THAT(messageOf("nowhere", "laser", 6_s), HasSubstr("nowhere"));
  EXPECT_THAT(messageOf("a", "laser", 6_s), HasSubstr("no ancestor"));
  EXPECT_EQ(nodes::inertialFrame(*buffer, "b"), "a");
  EXPECT_EQ(nodes::inertialFrame(*buffer, "/unknown"), "unknown");
}

}  // namespace
}  // namespace stillframe::test
