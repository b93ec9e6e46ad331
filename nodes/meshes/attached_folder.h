#pragma once

#include <filesystem>
#include <vector>

#include "scenegraph/store/resources.h"

namespace stillframe::nodes {

/// Attachments of a recording, laid out as files in a temporary folder for as long as this lives.
///
/// For a mesh whose format refers to files beside it: the importer is another process and reads files. Holds what a
/// mesh may refer to (materials, buffers, pictures; by the ending), under the names that the attachments have, without
/// what would lead out of the folder; 256 MiB at most. Empty when there is none of those. Move only; any thread.
class AttachedFolder {
 public:
  AttachedFolder() = default;
  AttachedFolder(const std::vector<scenegraph::Resources::Attachment>& all,
                 const scenegraph::Resources::Attachment& mesh);
  ~AttachedFolder();
  AttachedFolder(const AttachedFolder&) = delete;
  AttachedFolder& operator=(const AttachedFolder&) = delete;
  AttachedFolder(AttachedFolder&& other) noexcept;
  AttachedFolder& operator=(AttachedFolder&& other) = delete;

  /// "" when it is empty.
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// Where `mesh` would lie among the others.
  [[nodiscard]] std::filesystem::path fileOf(const scenegraph::Resources::Attachment& mesh) const;

 private:
  std::filesystem::path path_;
};

}  // namespace stillframe::nodes
