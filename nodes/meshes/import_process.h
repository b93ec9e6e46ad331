#pragma once

#include <cstddef>
#include <expected>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "nodes/meshes/import_sandbox.h"
#include "nodes/meshes/mesh_data.h"
#include "scenegraph/status.h"

namespace stillframe::nodes {

/// A mesh to import in a process of its own.
struct ImportRequest {
  std::span<const std::byte> bytes;
  std::string format;                 ///< "stl", "dae", ...
  std::filesystem::path file = {};    ///< as in MeshImport
  std::filesystem::path within = {};  ///< as in MeshImport
  bool use_collada_up_axis = false;
  ImportLimits limits = {};
};

/// The program that imports: named by STILLFRAME_MESH_IMPORTER, else beside the running program, beside the library
/// that this code is in, in libexec/stillframe next to either, or where it is installed. nullopt: in none of these.
[[nodiscard]] std::optional<std::filesystem::path> findMeshImporter();

/// Limits by the size of the file: enough for five million triangles, soon over for a file that hangs the importer.
[[nodiscard]] ImportLimits importLimits(std::size_t file_bytes) noexcept;

/// Imports a mesh in a child process; blocks for as long as that takes (a few milliseconds for the process itself, at
/// most twice the limit of CPU time and 5 s). Whatever the file does to the importer, here it is a status:
/// "MeshUnreadable", "MeshImportCrashed", "MeshImportHung", "MeshTooLarge", "NoMeshImporter", "MeshImportGarbled". Any
/// thread.
[[nodiscard]] std::expected<MeshData, scenegraph::Status> importInProcess(const ImportRequest& request);

}  // namespace stillframe::nodes
