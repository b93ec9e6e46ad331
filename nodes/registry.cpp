#include "nodes/registry.h"

#include <vector>

#include "nodes/compressed_cloud/compressed_cloud_layer.h"
#include "nodes/depth_image/depth_image_layer.h"
#include "nodes/grid/grid_layer.h"
#include "nodes/grid_map/grid_map_layer.h"
#include "nodes/laser_scan/laser_scan_layer.h"
#include "nodes/markers/markers_layer.h"
#include "nodes/occupancy_grid/occupancy_grid_layer.h"
#include "nodes/point_cloud/point_cloud_layer.h"
#include "nodes/poses/poses_layer.h"
#include "nodes/robot_model/robot_model_layer.h"
#include "nodes/tf_axes/tf_axes_layer.h"
#include "nodes/voxel_grid/voxel_grid_layer.h"

namespace stillframe::nodes {

std::span<const scenegraph::LayerType> layerTypes() {
  using enum scenegraph::ObjectType;
  static const std::vector<scenegraph::LayerType> kTypes{
      {"grid", "Grid", None, &GridLayer::create},
      {"tf", "TF", None, &TfAxesLayer::create},
      {"point_cloud", "Point cloud", PointCloud, &PointCloudLayer::create},
      {"laser_scan", "Laser scan", LaserScan, &LaserScanLayer::create},
      {"occupancy_grid", "Occupancy grid", OccupancyGrid, &OccupancyGridLayer::create,
       &OccupancyGridLayer::takesOrphan},
      {"compressed_cloud", "Compressed cloud", CompressedPointCloud, &createCompressedCloudLayer},
      {"grid_map", "Grid map", GridMap, &GridMapLayer::create},
      {"poses", "Poses", PosesInFrame, &PosesLayer::create},
      {"depth_image", "Depth image", Image, &DepthImageLayer::create},
      {"robot_model", "Robot", RobotDescription, &RobotModelLayer::create},
      {"voxel_grid", "Voxel grid", VoxelGrid, &VoxelGridLayer::create},
      {"markers", "Markers", SceneEntities, &MarkersLayer::create},
  };
  return kTypes;
}

}  // namespace stillframe::nodes
