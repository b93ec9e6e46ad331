#pragma once

#include <cstddef>
#include <expected>
#include <filesystem>
#include <span>
#include <string>

#include "nodes/meshes/mesh_data.h"

namespace stillframe::nodes {

/// A mesh file and how to read it.
struct MeshImport {
  std::span<const std::byte> bytes;
  std::string format;               ///< how the name of such a file ends: "stl", "dae", ...
  std::filesystem::path file = {};  ///< where the bytes come from; empty: from memory, nothing beside it is read
  std::filesystem::path within =
      {};                            ///< files beside it (materials, buffers, textures) are read from beneath here only
  bool use_collada_up_axis = false;  ///< false: Collada's <up_axis> is ignored, as RViz does
};

/// Reads a mesh through assimp. Only for the importing process: some files crash, abort or hang assimp.
///
/// What comes out is metres and Z up by the conventions of RViz: STL, OBJ and PLY as they are; Collada scaled by its
/// <unit>, its <up_axis> ignored unless asked for; glTF turned from its Y-up (+90 degrees about X). Lines and points
/// are left out, so are triangles of vertices that are not finite. The error is one sentence.
[[nodiscard]] std::expected<MeshData, std::string> importMesh(const MeshImport& import);

}  // namespace stillframe::nodes
