#pragma once

#include <cstddef>
#include <expected>
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

/// Models by modelKey(): the mesh, or why there is none.
struct ModelSet {
  using Loaded = std::expected<std::shared_ptr<const MeshArrays>, scenegraph::Status>;
  std::map<std::string, Loaded> models;
};

/// Models that are wanted, by modelKey(); each with an entity that it belongs to, which keeps its bytes.
using WantedModels = std::map<std::string, std::shared_ptr<const scenegraph::SceneEntity>>;

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
