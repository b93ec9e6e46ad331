#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "nodes/meshes/mesh_data.h"
#include "nodes/meshes/mesh_loader.h"
#include "scenegraph/objects/scene_entities.h"
#include "scenegraph/status.h"

namespace stillframe::nodes {

/// The mesh that a list of triangles with a texture is.
struct TexturedTriangles {
  MeshData mesh;           ///< without the texture when that failed, and without triangles when all are unsound
  glm::dvec3 origin{0.0};  ///< what its positions are relative to, in the space of the primitive
  std::optional<scenegraph::Status> failure = {};
};

/// The picture comes from the message or, by its name, from wherever meshes do. It multiplies the colours; triangles
/// that have none of their own are lit, as RViz does both. Blocks as MeshLoader does; any thread but the GUI's.
[[nodiscard]] TexturedTriangles texturedTriangles(const scenegraph::TrianglePrimitive& triangles,
                                                  const MeshLoader& loader);

}  // namespace stillframe::nodes
