#include "nodes/meshes/attached_folder.h"

#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace stillframe::nodes {
namespace {

namespace fs = std::filesystem;
using scenegraph::Resources;

constexpr std::uint64_t kMostBytes = std::uint64_t{256} << 20U;
constexpr std::array<std::string_view, 7> kEndings{".mtl", ".bin", ".png", ".jpg", ".jpeg", ".xml", ".material"};

bool isBeside(const Resources::Attachment& attachment) {
  std::string ending = fs::path(attachment.name).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::ranges::find(kEndings, ending) != kEndings.end();
}

/// The name within the folder: without scheme, root, "." and "..".
fs::path relativeName(std::string_view name) {
  const std::size_t colon = name.find("://");
  fs::path result;
  for (const fs::path& part : fs::path(colon == std::string_view::npos ? name : name.substr(colon + 3))) {
    if (part != "." && part != ".." && part != "/" && !part.empty() && part.native().find('\0') == std::string::npos) {
      result /= part;
    }
  }
  return result;
}

}  // namespace

AttachedFolder::AttachedFolder(const std::vector<Resources::Attachment>& all, const Resources::Attachment& mesh) {
  std::uint64_t bytes = 0;
  for (const Resources::Attachment& attachment : all) {
    const fs::path name = relativeName(attachment.name);
    if (attachment.name == mesh.name || name.empty() || !isBeside(attachment) ||
        attachment.bytes > kMostBytes - bytes) {
      continue;
    }
    const auto content = attachment.read();
    if (!content) {
      continue;  // the importer says what it misses
    }
    std::error_code error;
    if (path_.empty()) {
      std::string pattern = (fs::temp_directory_path(error) / "stillframe-mesh-XXXXXX").string();
      if (error || mkdtemp(pattern.data()) == nullptr) {
        return;
      }
      path_ = pattern;
    }
    bytes += content->bytes.size();
    fs::create_directories((path_ / name).parent_path(), error);
    std::ofstream(path_ / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(content->bytes.data()),
               static_cast<std::streamsize>(content->bytes.size()));
  }
}

AttachedFolder::AttachedFolder(AttachedFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}

AttachedFolder::~AttachedFolder() {
  if (!path_.empty()) {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
}

fs::path AttachedFolder::fileOf(const Resources::Attachment& mesh) const { return path_ / relativeName(mesh.name); }

}  // namespace stillframe::nodes
