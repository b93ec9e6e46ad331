#pragma once

#include <cstddef>
#include <expected>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/meshes/mesh_data.h"
#include "nodes/meshes/resource_finder.h"
#include "scenegraph/status.h"
#include "scenegraph/store/object_cache.h"

namespace stillframe::nodes {

/// What changes the bytes of an imported mesh.
struct MeshOptions {
  bool use_collada_up_axis = false;  ///< false: Collada's <up_axis> is ignored, as RViz does

  friend bool operator==(const MeshOptions&, const MeshOptions&) = default;
};

/// Meshes by name or from memory, imported in a child process and cached by content.
///
/// Call it on a worker: a load blocks for the disk and the import. A mesh that was imported before, by whichever layer
/// of the dataset, comes from the cache at once, a failure too: it is not tried again while the cache holds it. The
/// cache key is a hash of the file's bytes, and its path where the format refers to files beside it. Any thread.
class MeshLoader {
 public:
  using Loaded = std::expected<std::shared_ptr<const MeshData>, scenegraph::Status>;

  /// `cache` outlives the loader.
  MeshLoader(scenegraph::ObjectCache& cache, const scenegraph::Resources& resources,
             std::vector<std::filesystem::path> more_paths = {})
      : cache_(cache), finder_(resources, std::move(more_paths)) {}

  /// The mesh that a message or file names. The status tells the path; codes are those of ResourceFinder and
  /// importInProcess().
  [[nodiscard]] Loaded load(const std::string& uri, const std::filesystem::path& named_by = {},
                            const MeshOptions& options = {}) const;
  /// Several, in order; as many at a time as there are cores, at most four.
  [[nodiscard]] std::vector<Loaded> loadAll(std::span<const std::string> uris,
                                            const std::filesystem::path& named_by = {},
                                            const MeshOptions& options = {}) const;
  /// A mesh in memory; `format` is a file ending or a media type ("glb", "model/gltf-binary"). "" goes by the content.
  [[nodiscard]] Loaded loadBytes(std::span<const std::byte> bytes, std::string_view format,
                                 const MeshOptions& options = {}) const;
  /// The bytes of a file that is named like a mesh: a texture of a robot's material.
  [[nodiscard]] std::expected<std::vector<std::byte>, scenegraph::Status> read(
      const std::string& uri, const std::filesystem::path& named_by = {}) const;

 private:
  [[nodiscard]] Loaded import(std::span<const std::byte> bytes, const std::string& format, const FoundResource& from,
                              const MeshOptions& options) const;

  scenegraph::ObjectCache& cache_;
  ResourceFinder finder_;
};

/// "stl", "dae", "obj", "gltf", "glb", "ply", ... of a media type, a file ending or, where that says nothing, the first
/// bytes; "" when nothing tells.
[[nodiscard]] std::string meshFormat(std::string_view ending_or_media_type, std::span<const std::byte> bytes);

}  // namespace stillframe::nodes
