#include "scenegraph/objects/object.h"

namespace stillframe::scenegraph {

std::string_view toString(ObjectType type) noexcept {
  switch (type) {
    case ObjectType::None:
      return "";
    case ObjectType::Image:
      return "Image";
    case ObjectType::PointCloud:
      return "PointCloud";
    case ObjectType::DepthImage:
      return "DepthImage";
    case ObjectType::FrameTransforms:
      return "FrameTransforms";
    case ObjectType::OccupancyGrid:
      return "OccupancyGrid";
    case ObjectType::CompressedPointCloud:
      return "CompressedPointCloud";
    case ObjectType::Mesh3D:
      return "Mesh3D";
    case ObjectType::SceneEntities:
      return "SceneEntities";
    case ObjectType::RobotDescription:
      return "RobotDescription";
    case ObjectType::CameraInfo:
      return "CameraInfo";
    case ObjectType::OccupancyGridUpdate:
      return "OccupancyGridUpdate";
    case ObjectType::PosesInFrame:
      return "PosesInFrame";
    case ObjectType::VoxelGrid:
      return "VoxelGrid";
    case ObjectType::GridMap:
      return "GridMap";
    case ObjectType::JointStates:
      return "JointStates";
    case ObjectType::LaserScan:
      return "LaserScan";
  }
  return "";
}

}  // namespace stillframe::scenegraph
