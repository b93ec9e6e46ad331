#pragma once

#include <cstddef>
#include <expected>
#include <filesystem>
#include <memory>
#include <optional>
#include <osg/BoundingBox>
#include <osg/Matrixd>
#include <string>
#include <vector>

#include "nodes/mesh_drawing/mesh_arrays.h"
#include "nodes/meshes/mesh_loader.h"
#include "nodes/robots/robot.h"
#include "scenegraph/objects/robot_description.h"

namespace stillframe::nodes {

/// A shape of a link as it is drawn.
struct RobotPiece {
  std::shared_ptr<const MeshArrays> mesh;
  osg::Matrixd link_from_mesh;
  std::optional<scenegraph::Color> color;  ///< of the description
  bool is_placeholder = false;             ///< stands for a mesh that is not there
};

/// A mesh that could not be shown.
struct RobotMeshFault {
  std::string link;
  scenegraph::Status status;
};

/// A robot with its meshes, read once for all views. Made on a worker; immutable but for releaseGlObjects().
class RobotScene {
 public:
  /// What it is made with; whoever asks for other parts gets another scene.
  struct Options {
    bool has_visuals = true;
    bool has_collisions = false;
    MeshOptions meshes;
  };
  struct Link {
    std::vector<RobotPiece> visuals;
    std::vector<RobotPiece> collisions;
    osg::BoundingBoxd visual_box;  ///< in the link's frame; invalid when empty
    osg::BoundingBoxd collision_box;
  };

  /// The error is that of the description. Meshes that are missing or broken leave a placeholder and a fault.
  [[nodiscard]] static std::expected<RobotScene, scenegraph::Status> make(
      const scenegraph::RobotDescription& description, const MeshLoader& loader, const Options& options);

  [[nodiscard]] const Robot& robot() const noexcept { return robot_; }
  /// One a link of robot().
  [[nodiscard]] const std::vector<Link>& links() const noexcept { return links_; }
  [[nodiscard]] const std::vector<RobotMeshFault>& faults() const noexcept { return faults_; }
  /// What else there is to say, a sentence; "" as a rule.
  [[nodiscard]] const std::string& remarks() const noexcept { return remarks_; }
  [[nodiscard]] std::size_t meshCount() const noexcept { return mesh_count_; }
  [[nodiscard]] std::size_t byteSize() const noexcept { return bytes_; }
  void releaseGlObjects() const;

 private:
  friend class RobotSceneBuilder;
  Robot robot_;
  std::vector<Link> links_;
  std::vector<RobotMeshFault> faults_;
  std::string remarks_;
  std::size_t mesh_count_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace stillframe::nodes
