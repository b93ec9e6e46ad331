#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "nodes/grid_map/map_cells.h"
#include "nodes/laser_scan/scan_cloud.h"
#include "nodes/laser_scan/sensor_motion.h"
#include "scenegraph/objects/grid_map.h"
#include "scenegraph/objects/laser_scan.h"
#include "tests/tools/sample/recorded_sample.h"
#include "tools/sample/robot.h"
#include "tools/sample/topic.h"

namespace stillframe::sample {
namespace {

using SampleScan = RecordedSample;

/// How far nine of ten points before the two free walls lie off them at most, in metres (the tenth may be the edge of
/// something that stands there); nullopt when hardly any are seen.
std::optional<double> offWalls(const scenegraph::PointCloud& cloud, const tf::RigidTransform& map_from_scanner) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < cloud.width; ++i) {
    float xyz[3];
    std::memcpy(xyz, cloud.data.bytes.data() + i * cloud.point_step, sizeof xyz);
    const auto point = tf::transformPoint(map_from_scanner, {xyz[0], xyz[1], xyz[2]});
    // Along the other two walls stand racks.
    if (const double off = std::abs(point.x) - 15.0; std::abs(off) < 0.2) {
      distances.push_back(std::abs(off));
    }
  }
  if (distances.size() <= 10) {
    return std::nullopt;
  }
  const auto nine_tenths = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() * 9 / 10);
  std::ranges::nth_element(distances, nine_tenths);
  return *nine_tenths;
}

TEST_F(SampleScan, DeskewedWallsAreFlatWithinACentimetre) {
  const Robot robot(RecordedSample::kOptions.seed, RecordedSample::kOptions.duration_ns);
  const auto scans = messages<scenegraph::LaserScan>("/scan");
  ASSERT_EQ(scans.size(), 41U);
  const tf::TransformBuffer& buffer = *recording_->dataset()->transforms();
  double worst_m = 0.0;
  double worst_raw_m = 0.0;
  int compared = 0;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const auto scan = nodes::convertScan(*scans[i]);
    ASSERT_TRUE(scan);
    const tf::TimePoint first = scans[i]->stamp;
    const auto end = tf::TimePoint{first.ns + std::llround(scan->duration_s * 1e9)};
    const auto motion = nodes::SensorMotion::sample(buffer, "odom", "scan_link", first, end);
    ASSERT_TRUE(motion) << motion.error().message;
    // By where the robot truly was, so that nothing but the shape of the scan is measured.
    const auto map_from_scanner = toRigid(robot.truth(first.ns - 1'700'000'000'000'000'000)) * baseFromScanner();
    const auto off_m = offWalls(nodes::deskew(scan->cloud, *motion, first), map_from_scanner);
    if (!off_m) {
      continue;
    }
    EXPECT_LT(*off_m, 0.01) << "scan " << i;
    worst_m = std::max(worst_m, *off_m);
    worst_raw_m = std::max(worst_raw_m, offWalls(scan->cloud, map_from_scanner).value_or(0.0));
    ++compared;
  }
  EXPECT_GE(compared, 10);
  EXPECT_GT(worst_raw_m, 0.02) << "nothing to mend";
  RecordProperty("off_um", static_cast<int>(worst_m * 1e6));
  RecordProperty("off_without_um", static_cast<int>(worst_raw_m * 1e6));
}

TEST_F(SampleScan, ElevationMapHasTheWarehouse) {
  const auto maps = messages<scenegraph::GridMap>("/elevation_map");
  ASSERT_EQ(maps.size(), 1U);
  EXPECT_EQ(maps[0]->column_count, 140U);
  EXPECT_EQ(maps[0]->row_count, 90U);
  const auto cells = nodes::readMapCells(*maps[0]);
  ASSERT_TRUE(cells) << cells.error().message;
  std::vector<float> heights(cells->all.points);
  const auto limits = nodes::convertChannel(cells->records, cells->all, cells->layers.front(), heights);
  EXPECT_EQ(limits.low, 0.0);
  EXPECT_LE(limits.high, 3.0);
  EXPECT_LT(limits.finite, heights.size()) << "racks are higher than the map reaches";
  // The loading dock, 1 m high, stands in the corner of both greatest coordinates and in no other.
  const auto heightAt = [&](double x, double y) {
    return heights[static_cast<std::size_t>((y + 9.0) / 0.2) * 140 + static_cast<std::size_t>((x + 14.0) / 0.2)];
  };
  EXPECT_NEAR(heightAt(13.5, 8.5), 1.0, 1e-6);
  EXPECT_NE(heightAt(13.5, -8.5), heightAt(13.5, 8.5));
  EXPECT_NE(heightAt(-13.5, 8.5), heightAt(13.5, 8.5));
}

}  // namespace
}  // namespace stillframe::sample
