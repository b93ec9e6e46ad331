#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <osg/BoundingBox>
#include <osg/Group>
#include <osg/ref_ptr>
#include <vector>

#include "nodes/markers/model_shelf.h"
#include "nodes/mesh_drawing/mesh_arrays.h"
#include "scenegraph/objects/scene_entities.h"
#include "scenegraph/status.h"

namespace stillframe::nodes {

/// Models, and triangles with a texture, of the entities in one frame.
///
/// A node for each, which shares its arrays with all that show the same mesh. What is missing or broken is a box of the
/// size of its scale, from 0.1 to 1 m, and failure() says why. A change makes the nodes anew. GUI thread.
class ModelParts {
 public:
  using Entities = std::map<std::size_t, std::shared_ptr<const scenegraph::SceneEntity>>;

  ModelParts();
  /// The meshes that there are by now; models without one are not drawn yet.
  void setModels(std::shared_ptr<const ModelSet> models);
  /// To be called when an entity with models or textured triangles came or went.
  void touch() noexcept { is_changed_ = true; }
  void setOpacity(double opacity) { state_.setOpacity(opacity); }
  /// Call once after changes.
  void commit(const Entities& entities);
  /// Adds those that the entities name.
  static void collect(const Entities& entities, WantedModels& wanted);

  [[nodiscard]] osg::Group& node() const noexcept { return *node_; }
  [[nodiscard]] std::size_t size() const { return node_->getNumChildren(); }
  /// Slot of the entity that a child of node() shows a part of; nullopt for other nodes.
  [[nodiscard]] std::optional<std::size_t> slotOf(const osg::Node* place) const;
  /// In the frame; invalid for nothing.
  [[nodiscard]] const osg::BoundingBoxd& box() const noexcept { return box_; }
  /// Left out, as their numbers make no sense.
  [[nodiscard]] std::size_t unsound() const noexcept { return unsound_; }
  /// Why the first that is not drawn as it should be is not, with the marker's name, and how many there are.
  [[nodiscard]] std::size_t failed() const noexcept { return failed_; }
  [[nodiscard]] const std::optional<scenegraph::Status>& failure() const noexcept { return failure_; }

 private:
  template <typename Primitive>
  void add(const Primitive& primitive, std::size_t slot, const scenegraph::SceneEntity& entity);

  std::shared_ptr<const ModelSet> models_;
  osg::ref_ptr<osg::Group> node_;
  std::vector<std::size_t> slots_;  // one a child of node_
  MeshState state_;
  bool is_changed_ = false;
  osg::BoundingBoxd box_;
  std::size_t unsound_ = 0;
  std::size_t failed_ = 0;
  std::optional<scenegraph::Status> failure_;
};

}  // namespace stillframe::nodes
