#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/objects/payload.h"

namespace stillframe::scenegraph {

/// Where the files that messages name are looked for: what came with the recording, and the user's folders. Any thread.
///
/// Part of a Dataset. Set before layers load; what has been loaded is not looked for again.
class Resources {
 public:
  /// A file within the recording.
  struct Attachment {
    std::string name;
    std::string media_type;
    std::uint64_t bytes = 0;
    /// Its content; blocks on the disk. The error is one sentence.
    std::function<std::expected<Payload, std::string>()> read;
  };

  void addAttachment(Attachment attachment) {
    const std::scoped_lock lock(mutex_);
    attachments_.push_back(std::move(attachment));
  }
  [[nodiscard]] std::vector<Attachment> attachments() const {
    const std::scoped_lock lock(mutex_);
    return attachments_;
  }
  /// Packages, folders of packages, or workspaces: looked through before those of the environment.
  void setSearchPaths(std::vector<std::filesystem::path> paths) {
    const std::scoped_lock lock(mutex_);
    search_paths_ = std::move(paths);
  }
  [[nodiscard]] std::vector<std::filesystem::path> searchPaths() const {
    const std::scoped_lock lock(mutex_);
    return search_paths_;
  }

 private:
  mutable std::mutex mutex_;  // guards everything below
  std::vector<Attachment> attachments_;
  std::vector<std::filesystem::path> search_paths_;
};

}  // namespace stillframe::scenegraph
