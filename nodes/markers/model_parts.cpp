#include "nodes/markers/model_parts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <osg/MatrixTransform>
#include <string>
#include <utility>

#include "nodes/markers/entity_shapes.h"
#include "nodes/osg_math.h"

namespace stillframe::nodes {
namespace {

using scenegraph::Color;
using scenegraph::ModelPrimitive;
using scenegraph::SceneEntity;
using scenegraph::TrianglePrimitive;

constexpr double kLeastPlaceholder_m = 0.1;
constexpr double kMostPlaceholder_m = 1.0;

/// How a marker is named to people: a ROS marker by its namespace and number.
std::string nameOf(const SceneEntity& entity) {
  const std::string& space = entity.marker_namespace;
  const std::string start = std::to_string(space.size()) + ":" + space + ":";
  const bool is_ros = entity.id.starts_with(start);
  return is_ros && !space.empty() ? "the marker " + entity.id.substr(start.size()) + " of '" + space + "'"
                                  : "the marker '" + (is_ros ? entity.id.substr(start.size()) : entity.id) + "'";
}

struct Look {
  glm::dvec3 scale{1.0};
  Color color;
  bool is_overriding = false;
};

Look lookOf(const ModelPrimitive& model) {
  Look look{model.scale, {model.color.r, model.color.g, model.color.b, model.color.a}, model.is_color_override};
  if (!model.is_color_override && !(model.color.a > 0.0F)) {
    look.color = {};  // as sent where the mesh's own colours are meant
  }
  return look;
}

Look lookOf(const TrianglePrimitive& /*triangles*/) { return {}; }

/// Nobody knows the size. Edges of the scale, but 1 mm for a mesh in millimetres would not be seen, and what is scaled
/// up is small.
Look placeholderLook(Look look) {
  for (int axis = 0; axis < 3; ++axis) {
    look.scale[axis] = std::clamp(std::abs(look.scale[axis]), kLeastPlaceholder_m, kMostPlaceholder_m);
  }
  return {look.scale, kPlaceholderColor, true};
}

}  // namespace

ModelParts::ModelParts() : node_(new osg::Group) { node_->setStateSet(state_.stateSet()); }

void ModelParts::setModels(std::shared_ptr<const ModelSet> models) {
  if (models_ != models) {
    models_ = std::move(models);
    is_changed_ = true;
  }
}

void ModelParts::collect(const Entities& entities, WantedModels& wanted) {
  for (const auto& [slot, entity] : entities) {
    for (const ModelPrimitive& model : entity->models) {
      wanted.emplace(modelKey(model), entity);
    }
    for (const TrianglePrimitive& triangles : entity->triangles) {
      if (isTextured(triangles)) {
        wanted.emplace(modelKey(triangles), entity);
      }
    }
  }
}

template <typename Primitive>
void ModelParts::add(const Primitive& primitive, std::size_t slot, const SceneEntity& entity) {
  const auto found = models_->models.find(modelKey(primitive));
  if (found == models_->models.end()) {
    return;  // under way
  }
  const ShelfModel& model = found->second;
  const Look own = lookOf(primitive);
  const Look look = model.is_placeholder ? placeholderLook(own) : own;
  const tf::RigidTransform pose = soundPose(primitive.pose);
  if (!tf::isFinite(pose) || glm::length(pose.translation) > kReach_m || !(glm::length(own.scale) < 1e9)) {
    ++unsound_;
    return;
  }
  if (model.failure && failed_++ == 0) {
    failure_ = model.failure;
    failure_->message =
        nameOf(entity) + ": " + failure_->message + (model.is_placeholder ? "; a box stands for it" : "");
  }
  const osg::ref_ptr<osg::MatrixTransform> place =
      new osg::MatrixTransform(osg::Matrixd::translate(toOsg(model.origin)) *
                               osg::Matrixd::scale(look.scale.x, look.scale.y, look.scale.z) * toOsg(pose));
  place->addChild(model.mesh->makeNode(look.color, look.is_overriding));
  node_->addChild(place);
  slots_.push_back(slot);
  for (unsigned i = 0; model.mesh->box().valid() && i < 8; ++i) {
    box_.expandBy(model.mesh->box().corner(i) * place->getMatrix());
  }
}

void ModelParts::commit(const Entities& entities) {
  if (!is_changed_ || models_ == nullptr) {
    return;
  }
  is_changed_ = false;
  node_->removeChildren(0, node_->getNumChildren());
  slots_.clear();
  unsound_ = failed_ = 0;
  failure_.reset();
  box_.init();
  for (const auto& [slot, entity] : entities) {
    for (const ModelPrimitive& model : entity->models) {
      add(model, slot, *entity);
    }
    for (const TrianglePrimitive& triangles : entity->triangles) {
      if (isTextured(triangles)) {
        add(triangles, slot, *entity);
      }
    }
  }
}

std::optional<std::size_t> ModelParts::slotOf(const osg::Node* place) const {
  const unsigned child = node_->getChildIndex(place);
  return child < slots_.size() ? std::optional(slots_[child]) : std::nullopt;
}

}  // namespace stillframe::nodes
