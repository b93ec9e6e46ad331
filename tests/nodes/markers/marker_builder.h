#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/objects/scene_entities.h"
#include "tests/support/builders.h"

namespace stillframe::test {

inline constexpr scenegraph::EntityColor kRed{0.8F, 0.2F, 0.1F, 1.0F};
inline constexpr scenegraph::EntityColor kGreen{0.0F, 1.0F, 0.0F, 1.0F};
inline constexpr scenegraph::EntityColor kWhite{};

inline tf::RigidTransform at(double x, double y, double z = 0.0) { return {.translation = {x, y, z}}; }

inline scenegraph::SceneEntity entityIn(const std::string& frame, const std::string& id,
                                        const std::string& marker_namespace = "") {
  scenegraph::SceneEntity entity;
  entity.frame_id = frame;
  entity.id = id;
  entity.marker_namespace = marker_namespace;
  entity.is_frame_locked = true;
  return entity;
}

inline scenegraph::SceneEntity cube(const std::string& id, double x, double y, const scenegraph::EntityColor& color,
                                    double size = 2.0) {
  scenegraph::SceneEntity entity = entityIn("map", id, id);
  entity.cubes.push_back({.pose = at(x, y), .size = glm::dvec3(size), .color = color});
  return entity;
}

inline scenegraph::SceneEntities sceneOf(std::vector<scenegraph::SceneEntity> entities) {
  scenegraph::SceneEntities scene;
  for (scenegraph::SceneEntity& entity : entities) {
    scene.steps.push_back({false, scene.entities.size()});
    scene.entities.push_back(std::move(entity));
  }
  return scene;
}

inline std::shared_ptr<scenegraph::Dataset> datasetOf(scenegraph::SceneEntities scene,
                                                      const tf::RigidTransform& map_from_base = {}) {
  return DatasetBuilder()
      .topic("/tf", scenegraph::ObjectType::FrameTransforms)
      .transform(0, "map", "base", map_from_base)
      .topic("/markers", scenegraph::ObjectType::SceneEntities)
      .at(1_s, std::move(scene))
      .build();
}

}  // namespace stillframe::test
