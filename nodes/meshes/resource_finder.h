#pragma once

#include <expected>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/meshes/attached_folder.h"
#include "scenegraph/status.h"
#include "scenegraph/store/resources.h"

namespace stillframe::nodes {

/// A file that a message names: on the disk, or within the recording.
struct FoundResource {
  std::filesystem::path file;    ///< "" for an attachment
  std::filesystem::path within;  ///< the package or folder that files beside it may come from
  std::optional<scenegraph::Resources::Attachment> attachment = {};
};

/// Finds the files of robot descriptions and mesh markers.
///
/// Takes `package://`, `model://`, `file://`, absolute and relative names. First the recording's attachments of that
/// name, then the user's folders, then ROS_PACKAGE_PATH, AMENT_PREFIX_PATH, COLCON_PREFIX_PATH and CMAKE_PREFIX_PATH
/// (for models GZ_SIM_RESOURCE_PATH, IGN_GAZEBO_RESOURCE_PATH, GAZEBO_MODEL_PATH before them), then the packages round
/// the file that names it. A folder counts as a package by the name in its package.xml or by its own. A name that leads
/// out of its package by ".." is refused. Searching a workspace walks at most 20 000 folders, once. Any thread.
class ResourceFinder {
 public:
  /// `more_paths` come before those of `resources`.
  explicit ResourceFinder(const scenegraph::Resources& resources, std::vector<std::filesystem::path> more_paths = {});

  /// `named_by`: the file with the name in it, "" for a message. Codes: "MeshMissing", "UnknownPackage",
  /// "PathEscapesPackage", "UnsupportedUri".
  [[nodiscard]] std::expected<FoundResource, scenegraph::Status> find(std::string_view uri,
                                                                      const std::filesystem::path& named_by = {}) const;
  /// What came with the recording beside `attachment`, as files: a mesh may refer to materials and pictures.
  [[nodiscard]] AttachedFolder folderOf(const scenegraph::Resources::Attachment& attachment) const {
    return {attachments_, attachment};
  }

 private:
  [[nodiscard]] std::optional<scenegraph::Resources::Attachment> findAttachment(std::string_view path,
                                                                                bool by_last_name) const;
  [[nodiscard]] std::optional<std::filesystem::path> findPackage(const std::string& name, bool is_model,
                                                                 const std::filesystem::path& named_by) const;
  void index(const std::filesystem::path& root) const;

  std::vector<scenegraph::Resources::Attachment> attachments_;
  std::vector<std::filesystem::path> paths_;
  mutable std::mutex mutex_;  // guards everything below
  mutable std::map<std::filesystem::path, std::map<std::string, std::filesystem::path>> packages_;  // by root
};

/// "a%20b" to "a b"; what is no escape stays.
[[nodiscard]] std::string decodePercent(std::string_view text);

}  // namespace stillframe::nodes
