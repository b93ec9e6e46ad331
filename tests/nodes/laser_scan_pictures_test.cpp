#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "scenegraph/objects/laser_scan.h"
#include "tests/nodes/scene_picture.h"

namespace stillframe::test {
namespace {

using scenegraph::LaserScan;
using scenegraph::ObjectType;
using testing::HasSubstr;

constexpr double kRate_rad_s = 2.0;

/// 200 beams from -60 to +60 degrees in 0.1 s, of a sensor that turns and sees a wall at x = 6 of odom.
LaserScan wallScan(std::int64_t first_ns) {
  LaserScan scan;
  scan.frame_id = "laser";
  scan.stamp = {first_ns};
  scan.angle_min_rad = -std::numbers::pi / 3;
  scan.angle_increment_rad = 2 * std::numbers::pi / 3 / 199;
  scan.time_increment_s = 0.1 / 199;
  scan.range_max_m = 30.0;
  for (int i = 0; i < 200; ++i) {
    const double yaw = kRate_rad_s * (static_cast<double>(first_ns) * 1e-9 + i * scan.time_increment_s);
    const double along = std::cos(yaw + scan.angle_min_rad + i * scan.angle_increment_rad);
    scan.ranges_m.push_back(along > 0.2 ? 6.0 / along : std::numeric_limits<double>::infinity());
  }
  return scan;
}

/// Transforms at 50 Hz; `log_minus_header_ns` puts the recording's clock that far from the stamps.
std::shared_ptr<scenegraph::Dataset> turning(std::int64_t log_minus_header_ns = 0) {
  DatasetBuilder builder;
  builder.topic("/tf", ObjectType::FrameTransforms);
  for (std::int64_t ns = 0; ns <= 1_s; ns += 20_ms) {
    builder.transform(ns + log_minus_header_ns, "odom", "laser", turn(kRate_rad_s * static_cast<double>(ns) * 1e-9),
                      ns);
  }
  // Sent when it was complete.
  const std::int64_t logged_ns = log_minus_header_ns == 0 ? 5_ms : log_minus_header_ns + 105_ms;
  return builder.topic("/scan", ObjectType::LaserScan).at(logged_ns, wallScan(5_ms)).build();
}

/// First and last column with a pixel.
std::pair<int, int> columnsDrawn(const scenegraph::BytePicture& picture) {
  std::pair<int, int> columns{picture.width, -1};
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (picture.rgb[static_cast<std::size_t>(y * picture.width + x) * 3] > 0) {
        columns = {std::min(columns.first, x), std::max(columns.second, x)};
      }
    }
  }
  return columns;
}

class ScanPicture : public ScenePictureTest {};

TEST_F(ScanPicture, SaysWhenNoBeamReturned) {
  LaserScan scan = wallScan(0);
  scan.frame_id = "odom";
  scan.range_max_m = 1.0;
  const auto dataset = [](LaserScan shown) {
    return DatasetBuilder()
        .topic("/tf", ObjectType::FrameTransforms)
        .transform(0, "odom", "laser")
        .topic("/scan", ObjectType::LaserScan)
        .at(1_s, std::move(shown))
        .build();
  };
  open(dataset(scan), "odom");
  const auto* layer = &add("/scan");
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
  EXPECT_EQ(layer->status().code, "NoReturns");
  EXPECT_THAT(layer->status().message, HasSubstr("none of its 200 ranges"));
  scan.ranges_m.clear();
  open(dataset(scan), "odom");
  layer = &add("/scan");
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
  EXPECT_EQ(layer->status().code, "NoPoints");
}

TEST_F(ScanPicture, DrawsAWallFlatSeenByATurningSensor) {
  open(turning(), "laser");
  auto& layer = add("/scan", {{"color_field", "flat"}, {"point_size", "1"}});
  // In the laser's own frame of 0 s, which is what it hangs in at 5 ms; 0.01 rad of hold tilt the wall a little.
  auto columns = columnsDrawn(draw(5_ms, fromAbove()));
  EXPECT_LE(columns.second - columns.first, 3) << "10 pixels a metre, 20 m tall, tilted by 0.01 rad";
  EXPECT_EQ(layer.status(), scenegraph::Status{});
  const auto counts = layer.counts();
  EXPECT_EQ(counts.front().second + counts[1].second, 200U);
  EXPECT_EQ(counts.back(), (std::pair<std::string, std::uint64_t>{"deskewed", counts.front().second}));
  ASSERT_TRUE(layer.applySettings({{"deskew", "false"}}));
  columns = columnsDrawn(draw(5_ms, fromAbove()));
  EXPECT_GT(columns.second - columns.first, 12) << "skewed by 0.2 rad at its far end";
  EXPECT_EQ(layer.counts().back().second, 0U);
}

TEST_F(ScanPicture, TakesBeamTimesOfTheClockInUse) {
  open(turning(1'000'000_s), "laser");
  add("/scan", {{"color_field", "flat"}, {"point_size", "1"}});
  ASSERT_EQ(dataset_->tfClockInUse(), scenegraph::TfClock::Log);
  const auto columns = columnsDrawn(draw(1'000'000_s + 105_ms, fromAbove()));
  EXPECT_LE(columns.second - columns.first, 3);
}

TEST_F(ScanPicture, SaysWhyAScanIsNotDeskewed) {
  open(turning(), "laser");
  auto& layer = add("/scan", {{"deskew_frame", "nowhere"}});
  EXPECT_GT(drawnPixels(draw(5_ms, fromAbove())), 100);
  EXPECT_EQ(layer.status().level, scenegraph::StatusLevel::Info);
  EXPECT_EQ(layer.status().code, "NotDeskewed");
  EXPECT_THAT(layer.status().message, HasSubstr("nowhere"));
  LaserScan slow = wallScan(5_ms);
  slow.time_increment_s = 1.0;
  open(DatasetBuilder().topic("/scan", ObjectType::LaserScan).at(1_s, slow).build(), "laser");
  auto& other = add("/scan");
  draw(1_s, fromAbove());
  EXPECT_EQ(other.status().code, "NotDeskewed");
  EXPECT_THAT(other.status().message, HasSubstr("199.0"));
}

TEST_F(ScanPicture, ColoursByRangeLikeAnyCloud) {
  open(turning(), "laser");
  auto& layer = add("/scan", {{"color_field", "range"}});
  draw(5_ms, fromAbove());
  EXPECT_EQ(layer.status(), scenegraph::Status{});
  EXPECT_THAT(layer.settingSpecs().front().choices, testing::ElementsAre("auto", "x", "y", "z", "flat", "range"));
}

}  // namespace
}  // namespace stillframe::test
