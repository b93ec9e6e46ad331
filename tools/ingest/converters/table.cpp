#include <array>

#include "tools/ingest/converters/converter.h"
#include "tools/ingest/converters/converters.h"

namespace stillframe::ingest {

std::span<const ConverterType> converterTypes() {
  using scenegraph::ObjectType;
  static constexpr auto kTypes = std::to_array<ConverterType>({
      {"tf2_msgs/TFMessage", ObjectType::FrameTransforms, converters::rosTransforms},
      {"tf/tfMessage", ObjectType::FrameTransforms, converters::rosTransforms},
      {"geometry_msgs/TransformStamped", ObjectType::FrameTransforms, converters::rosTransform},
      {"sensor_msgs/PointCloud2", ObjectType::PointCloud, converters::rosPointCloud},
      {"point_cloud_interfaces/CompressedPointCloud2", ObjectType::CompressedPointCloud,
       converters::rosCompressedCloud},
      {"sensor_msgs/LaserScan", ObjectType::LaserScan, converters::rosLaserScan},
      {"nav_msgs/OccupancyGrid", ObjectType::OccupancyGrid, converters::rosOccupancyGrid},
      {"map_msgs/OccupancyGridUpdate", ObjectType::OccupancyGridUpdate, converters::rosOccupancyGridUpdate},
      {"grid_map_msgs/GridMap", ObjectType::GridMap, converters::rosGridMap},
      {"nav2_msgs/VoxelGrid", ObjectType::VoxelGrid, converters::rosBitVoxelGrid},
      {"sensor_msgs/Image", ObjectType::Image, converters::rosImage},
      {"sensor_msgs/CompressedImage", ObjectType::Image, converters::rosCompressedImage},
      {"sensor_msgs/CameraInfo", ObjectType::CameraInfo, converters::rosCameraInfo},
      {"geometry_msgs/PoseArray", ObjectType::PosesInFrame, converters::rosPoseArray},
      {"nav_msgs/Path", ObjectType::PosesInFrame, converters::rosPath},
      {"geometry_msgs/PoseStamped", ObjectType::PosesInFrame, converters::rosPose},
      {"geometry_msgs/PoseWithCovarianceStamped", ObjectType::PosesInFrame, converters::rosPoseWithCovariance},
      {"nav_msgs/Odometry", ObjectType::PosesInFrame, converters::rosPoseWithCovariance},
      {"geometry_msgs/PointStamped", ObjectType::PosesInFrame, converters::rosPoint},
      {"geometry_msgs/PolygonStamped", ObjectType::PosesInFrame, converters::rosPolygon},
      {"visualization_msgs/Marker", ObjectType::SceneEntities, converters::rosMarker},
      {"visualization_msgs/MarkerArray", ObjectType::SceneEntities, converters::rosMarkers},
      {"std_msgs/String", ObjectType::RobotDescription, converters::rosRobotDescription, "robot_description"},
      {"sensor_msgs/JointState", ObjectType::JointStates, converters::rosJointState},
      {"foxglove_msgs/FrameTransforms", ObjectType::FrameTransforms, converters::foxgloveTransforms},
      {"foxglove_msgs/FrameTransform", ObjectType::FrameTransforms, converters::foxgloveTransform},
      {"foxglove_msgs/PointCloud", ObjectType::PointCloud, converters::foxglovePointCloud},
      {"foxglove_msgs/CompressedPointCloud", ObjectType::CompressedPointCloud, converters::foxgloveCompressedCloud},
      {"foxglove_msgs/LaserScan", ObjectType::LaserScan, converters::foxgloveLaserScan},
      {"foxglove_msgs/Grid", ObjectType::GridMap, converters::foxgloveGrid},
      {"foxglove_msgs/VoxelGrid", ObjectType::VoxelGrid, converters::foxgloveVoxelGrid},
      {"foxglove_msgs/RawImage", ObjectType::Image, converters::foxgloveRawImage},
      {"foxglove_msgs/CompressedImage", ObjectType::Image, converters::foxgloveCompressedImage},
      {"foxglove_msgs/CameraCalibration", ObjectType::CameraInfo, converters::foxgloveCameraCalibration},
      {"foxglove_msgs/PosesInFrame", ObjectType::PosesInFrame, converters::foxglovePoses},
      {"foxglove_msgs/PoseInFrame", ObjectType::PosesInFrame, converters::foxglovePose},
      {"foxglove_msgs/SceneUpdate", ObjectType::SceneEntities, converters::foxgloveScene},
      {"foxglove.FrameTransforms", ObjectType::FrameTransforms, converters::foxgloveTransforms},
      {"foxglove.FrameTransform", ObjectType::FrameTransforms, converters::foxgloveTransform},
      {"foxglove.PointCloud", ObjectType::PointCloud, converters::foxglovePointCloud},
      {"foxglove.CompressedPointCloud", ObjectType::CompressedPointCloud, converters::foxgloveCompressedCloud},
      {"foxglove.LaserScan", ObjectType::LaserScan, converters::foxgloveLaserScan},
      {"foxglove.Grid", ObjectType::GridMap, converters::foxgloveGrid},
      {"foxglove.VoxelGrid", ObjectType::VoxelGrid, converters::foxgloveVoxelGrid},
      {"foxglove.RawImage", ObjectType::Image, converters::foxgloveRawImage},
      {"foxglove.CompressedImage", ObjectType::Image, converters::foxgloveCompressedImage},
      {"foxglove.CameraCalibration", ObjectType::CameraInfo, converters::foxgloveCameraCalibration},
      {"foxglove.PosesInFrame", ObjectType::PosesInFrame, converters::foxglovePoses},
      {"foxglove.PoseInFrame", ObjectType::PosesInFrame, converters::foxglovePose},
      {"foxglove.SceneUpdate", ObjectType::SceneEntities, converters::foxgloveScene},
      {"PJ.FrameTransforms", ObjectType::FrameTransforms, converters::hostTransforms},
      {"PJ.PointCloud", ObjectType::PointCloud, converters::hostPointCloud},
      {"PJ.CompressedPointCloud", ObjectType::CompressedPointCloud, converters::hostCompressedCloud},
      {"PJ.OccupancyGrid", ObjectType::OccupancyGrid, converters::hostOccupancyGrid},
      {"PJ.OccupancyGridUpdate", ObjectType::OccupancyGridUpdate, converters::hostOccupancyGridUpdate},
      {"PJ.VoxelGrid", ObjectType::VoxelGrid, converters::hostVoxelGrid},
      {"PJ.GridMap", ObjectType::GridMap, converters::hostGridMap},
      {"PJ.Image", ObjectType::Image, converters::hostImage},
      {"PJ.CameraInfo", ObjectType::CameraInfo, converters::hostCameraInfo},
      {"PJ.PosesInFrame", ObjectType::PosesInFrame, converters::hostPoses},
      {"PJ.RobotDescription", ObjectType::RobotDescription, converters::hostRobotDescription},
      {"PJ.SceneEntities", ObjectType::SceneEntities, converters::hostScene},
  });
  return kTypes;
}

}  // namespace stillframe::ingest
