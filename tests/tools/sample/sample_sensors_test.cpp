#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <vector>

#include "nodes/images/camera_model.h"
#include "nodes/images/depth_map.h"
#include "nodes/points/codecs/decode_cloud.h"
#include "scenegraph/objects/compressed_point_cloud.h"
#include "scenegraph/objects/image.h"
#include "scenegraph/objects/occupancy_grid.h"
#include "tests/tools/sample/recorded_sample.h"
#include "tools/sample/robot.h"
#include "tools/sample/topic.h"

namespace stillframe::sample {
namespace {

class SampleSensors : public RecordedSample {
 protected:
  /// Height over the floor of every pixel that looks down and has a depth, the lens taken into account or not.
  std::vector<double> heights(nodes::PixelGrid grid) const {
    const auto image = messages<scenegraph::Image>("/rear_camera/depth/image_raw").at(3);
    const auto info = messages<scenegraph::CameraInfo>("/rear_camera/depth/camera_info").at(3);
    const auto model = nodes::CameraModel::make(*info, image->width, image->height, grid);
    const auto depths = nodes::decodeDepth(*image);
    EXPECT_TRUE(model && depths);
    const Robot robot(kOptions.seed, kOptions.duration_ns);
    const auto map_from_optical =
        toRigid(robot.truth(image->stamp.ns - kStart_ns)) * baseFromRearCamera() * cameraFromOptical();
    std::vector<double> result;
    for (std::uint32_t v = image->height / 2; v < image->height; ++v) {
      for (std::uint32_t u = 0; u < image->width; ++u) {
        const auto ray = model->ray(u, v);
        const double depth_m = static_cast<double>(depths->metres[std::size_t{v} * image->width + u]);
        if (ray && depth_m > 0.0) {
          const glm::dvec3 point{ray->at.x * depth_m, ray->at.y * depth_m, depth_m};
          result.push_back(tf::transformPoint(map_from_optical, point).z);
        }
      }
    }
    return result;
  }
  static double shareOnFloor(const std::vector<double>& heights_m) {
    const auto on_floor = std::ranges::count_if(heights_m, [](double z) { return std::abs(z) < 0.015; });
    return static_cast<double>(on_floor) / static_cast<double>(heights_m.size());
  }
};

TEST_F(SampleSensors, DepthImageMeetsTheFloorThroughItsLensOnly) {
  const std::vector<double> rectified = heights(nodes::PixelGrid::Raw);
  ASSERT_GT(rectified.size(), 5000U);
  EXPECT_GT(shareOnFloor(rectified), 0.5);
  EXPECT_LT(shareOnFloor(heights(nodes::PixelGrid::Undone)), 0.75 * shareOnFloor(rectified));
}

TEST_F(SampleSensors, MapUpdatesFollowTheRobot) {
  const auto maps = messages<scenegraph::OccupancyGrid>("/map");
  ASSERT_EQ(maps.size(), 1U);
  const scenegraph::OccupancyGrid& map = *maps[0];
  ASSERT_EQ(map.data.bytes.size(), std::size_t{map.width} * map.height);
  EXPECT_TRUE(std::ranges::all_of(map.data.bytes, [](std::byte cell) { return cell == std::byte{0xFF}; }));
  const auto patches = messages<scenegraph::OccupancyGridUpdate>("/map_updates");
  ASSERT_EQ(patches.size(), 17U);
  const Robot robot(kOptions.seed, kOptions.duration_ns);
  std::set<int> values;
  for (const auto& patch : patches) {
    ASSERT_EQ(patch->data.bytes.size(), std::size_t{patch->width} * patch->height);
    for (const std::byte cell : patch->data.bytes) {
      values.insert(static_cast<std::int8_t>(cell));
    }
    const Pose2 pose = robot.truth(patch->stamp.ns - kStart_ns);
    const auto column = static_cast<std::int32_t>((pose.x - map.origin.translation.x) / map.resolution_m) - patch->x;
    const auto row = static_cast<std::int32_t>((pose.y - map.origin.translation.y) / map.resolution_m) - patch->y;
    ASSERT_TRUE(column >= 0 && row >= 0 && column < static_cast<std::int32_t>(patch->width));
    EXPECT_EQ(patch->data.bytes[static_cast<std::size_t>(row) * patch->width + static_cast<std::size_t>(column)],
              std::byte{0})
        << "the robot stands on a free cell";
  }
  values.insert(-1);  // beyond the walls, where a square reaches that far
  EXPECT_EQ(values, (std::set<int>{-1, 0, 100}));
}

TEST_F(SampleSensors, CompressedCloudsAreTheLidarThinnedOut) {
  const auto packed = messages<scenegraph::CompressedPointCloud>("/lidar/thin/cloudini");
  const auto drawn = messages<scenegraph::CompressedPointCloud>("/lidar/thin/draco");
  ASSERT_EQ(packed.size(), 41U);
  ASSERT_EQ(drawn.size(), 41U);
  const auto cloudini = nodes::decodeCloud(*packed[7]);
  const auto draco = nodes::decodeCloud(*drawn[7]);
  ASSERT_TRUE(cloudini) << cloudini.error().message;
  ASSERT_TRUE(draco) << draco.error().message;
  ASSERT_EQ(cloudini->width, kOptions.lidar_points / 4);
  ASSERT_EQ(draco->width, cloudini->width);
  const auto at = [](const scenegraph::PointCloud& cloud, std::size_t point, std::size_t field) {
    float value = 0.0F;
    std::memcpy(&value, cloud.data.bytes.data() + point * cloud.point_step + cloud.fields[field].offset, sizeof value);
    return static_cast<double>(value);
  };
  ASSERT_EQ(cloudini->fields[3].name, "intensity");
  ASSERT_EQ(draco->fields[3].name, "intensity");
  for (std::size_t i = 0; i < cloudini->width; ++i) {
    for (const std::size_t axis : {0U, 1U, 2U}) {
      EXPECT_NEAR(at(*cloudini, i, axis), at(*draco, i, axis), 0.0005 + 40.0 / 16383.0);
    }
    EXPECT_NEAR(at(*cloudini, i, 3), at(*draco, i, 3), 0.51);
  }
}

}  // namespace
}  // namespace stillframe::sample
