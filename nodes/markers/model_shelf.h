#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "nodes/mesh_drawing/mesh_arrays.h"
#include "scenegraph/latest_job.h"
#include "scenegraph/layer.h"
#include "scenegraph/objects/scene_entities.h"
#include "scenegraph/status.h"

namespace stillframe::nodes {

/// What names the mesh of a model: its url, or where its bytes lie.
[[nodiscard]] std::string modelKey(const scenegraph::ModelPrimitive& model);
/// Triangles with a texture are drawn as models are.
[[nodiscard]] std::string modelKey(const scenegraph::TrianglePrimitive& triangles);
[[nodiscard]] bool isTextured(const scenegraph::TrianglePrimitive& triangles);

/// A mesh that is there, and what it lacks.
struct ShelfModel {
  std::shared_ptr<const MeshArrays> mesh;     ///< never null: a box of 1 m stands for what is missing or broken
  std::optional<scenegraph::Status> failure;  ///< why there is none, or none as it should be
  bool is_placeholder = false;
  glm::dvec3 origin{0.0};  ///< of the mesh, in the space of the primitive
};

/// Models that are wanted, by modelKey(); each with an entity that it belongs to, which keeps its bytes.
using WantedModels = std::map<std::string, std::shared_ptr<const scenegraph::SceneEntity>>;

/// Models by modelKey().
struct ModelSet {
  std::map<std::string, ShelfModel> models;
  WantedModels owners;  ///< as long as they live, no other bytes have the same key
};

/// Loads the meshes of models off the GUI thread, as MeshLoader does. GUI thread.
class ModelShelf {
 public:
  explicit ModelShelf(const scenegraph::LayerContext& context);

  /// Asks for what is not there yet. What is not wanted any more is let go of with the next that is.
  void want(const WantedModels& wanted);
  /// What is there, never null; another object when it changed.
  [[nodiscard]] const std::shared_ptr<const ModelSet>& models() const noexcept { return models_; }
  [[nodiscard]] bool isPending() const { return job_.isPending(); }

 private:
  std::shared_ptr<scenegraph::Dataset> dataset_;
  std::shared_ptr<const ModelSet> models_ = std::make_shared<const ModelSet>();
  scenegraph::LatestJob<ModelSet> job_;
};

}  // namespace stillframe::nodes
