#include "nodes/meshes/resource_finder.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <system_error>
#include <utility>

namespace stillframe::nodes {
namespace {

namespace fs = std::filesystem;
using scenegraph::failure;
using scenegraph::Resources;
using scenegraph::Status;
using scenegraph::StatusLevel;

constexpr std::size_t kMaxFolders = 20'000;
constexpr int kMaxDepth = 6;
constexpr int kMaxAncestors = 8;

bool isFolder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}
bool isFile(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// Folders of a variable, in order; `below` is put behind each.
void addPaths(std::vector<fs::path>& paths, const char* variable, std::string_view below = {}) {
  const char* const text = std::getenv(variable);
  std::string_view rest = text != nullptr ? text : "";
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    if (const auto path = rest.substr(0, colon); !path.empty()) {
      paths.push_back(below.empty() ? fs::path(path) : fs::path(path) / below);
    }
    rest = colon == std::string_view::npos ? "" : rest.substr(colon + 1);
  }
}

std::vector<fs::path> environmentPaths(bool is_model) {
  std::vector<fs::path> paths;
  if (is_model) {
    for (const char* const variable : {"GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH"}) {
      addPaths(paths, variable);
    }
  }
  addPaths(paths, "ROS_PACKAGE_PATH");
  for (const char* const variable : {"AMENT_PREFIX_PATH", "COLCON_PREFIX_PATH", "CMAKE_PREFIX_PATH"}) {
    addPaths(paths, variable, "share");
  }
  return paths;
}

/// What package.xml calls the package; "" when there is none.
std::string packageName(const fs::path& folder) {
  constexpr std::size_t kHead = std::size_t{1} << 16U;
  std::ifstream stream(folder / "package.xml", std::ios::binary);
  std::string text(kHead, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  const std::size_t open = text.find("<name>");
  const std::size_t close = open == std::string::npos ? open : text.find("</name>", open);
  if (close == std::string::npos) {
    return {};
  }
  std::string name = text.substr(open + 6, close - open - 6);
  std::erase_if(name, [](unsigned char c) { return c <= ' '; });
  return name;
}

bool isBeneath(const fs::path& file, const fs::path& folder) {
  const auto relative = file.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

/// The package that a file lies in, else the folder above its own.
fs::path surroundings(const fs::path& file) {
  fs::path folder = file.parent_path();
  for (int i = 0; i < kMaxAncestors && folder.has_relative_path(); ++i, folder = folder.parent_path()) {
    if (isFile(folder / "package.xml")) {
      return folder;
    }
  }
  return file.parent_path().parent_path();
}

std::string listed(const std::vector<fs::path>& paths) {
  constexpr std::size_t kMost = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(paths.size(), kMost); ++i) {
    text += (i == 0 ? "'" : "', '") + paths[i].string();
  }
  return text.empty() ? "" : text + "'" + (paths.size() > kMost ? " and more" : "");
}

}  // namespace

std::string decodePercent(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned value = 0;
    if (text[i] == '%' && i + 2 < text.size() + 0 &&
        std::from_chars(text.data() + i + 1, text.data() + i + 3, value, 16).ptr == text.data() + i + 3) {
      decoded += static_cast<char>(value);
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

ResourceFinder::ResourceFinder(const Resources& resources, std::vector<fs::path> more_paths)
    : attachments_(resources.attachments()), paths_(std::move(more_paths)) {
  for (fs::path& path : resources.searchPaths()) {
    paths_.push_back(std::move(path));
  }
  for (fs::path& path : paths_) {
    std::error_code error;
    auto absolute = fs::absolute(path, error).lexically_normal();
    path = error ? path : absolute.has_filename() ? absolute : absolute.parent_path();
  }
}

std::optional<Resources::Attachment> ResourceFinder::findAttachment(std::string_view path, bool by_last_name) const {
  const auto lastName = [](std::string_view name) { return name.substr(name.find_last_of('/') + 1); };
  const Resources::Attachment* found = nullptr;
  for (const Resources::Attachment& attachment : attachments_) {
    const std::string_view name = attachment.name;
    const auto endsWith = [](std::string_view text, std::string_view tail) {
      return text.ends_with(tail) && (text.size() == tail.size() || text[text.size() - tail.size() - 1] == '/');
    };
    const bool is_it = by_last_name           ? lastName(name) == lastName(path)
                       : endsWith(path, name) ? name.find('/') != std::string_view::npos || name == path
                                              : endsWith(name, path);
    if (is_it && found != nullptr && by_last_name) {
      return std::nullopt;  // which of them is meant cannot be told
    }
    found = is_it ? &attachment : found;
  }
  return found != nullptr ? std::optional(*found) : std::nullopt;
}

void ResourceFinder::index(const fs::path& root) const {
  auto& found = packages_[root];
  std::deque<std::pair<fs::path, int>> waiting{{root, 0}};
  std::size_t visited = 0;
  while (!waiting.empty() && visited < kMaxFolders) {
    const auto [folder, depth] = std::move(waiting.front());
    waiting.pop_front();
    ++visited;
    if (const std::string name = packageName(folder); !name.empty()) {
      found.emplace(name, folder);
      continue;  // packages hold no packages
    }
    std::vector<fs::path> inside;
    std::error_code error;
    for (fs::directory_iterator at(folder, fs::directory_options::skip_permission_denied, error), end;
         !error && at != end; at.increment(error)) {
      std::error_code ignored;
      const std::string name = at->path().filename().string();
      if (!name.starts_with('.') && at->is_directory(ignored) && inside.size() < kMaxFolders) {
        inside.push_back(at->path());
      }
    }
    std::ranges::sort(inside);
    for (fs::path& path : inside) {
      if (depth < kMaxDepth) {
        waiting.emplace_back(std::move(path), depth + 1);
      }
    }
  }
}

std::optional<fs::path> ResourceFinder::findPackage(const std::string& name, bool is_model,
                                                    const fs::path& named_by) const {
  std::vector<fs::path> roots = paths_;
  std::ranges::move(environmentPaths(is_model), std::back_inserter(roots));
  for (const fs::path& root : roots) {
    if (root.filename() == name || packageName(root) == name) {
      return root;
    }
    for (const auto& folder : {root / name, root / "share" / name}) {
      if (isFolder(folder)) {
        return folder;
      }
    }
  }
  const std::scoped_lock lock(mutex_);
  for (const fs::path& root : roots) {
    if (!packages_.contains(root)) {
      index(root);
    }
    const auto& found = packages_.at(root);
    if (const auto package = found.find(name); package != found.end()) {
      return package->second;
    }
  }
  fs::path folder = named_by.parent_path();
  for (int i = 0; i < kMaxAncestors && folder.has_relative_path(); ++i, folder = folder.parent_path()) {
    if (folder.filename() == name || packageName(folder) == name) {
      return folder;
    }
    if (isFolder(folder / name)) {
      return folder / name;
    }
  }
  return std::nullopt;
}

std::expected<FoundResource, Status> ResourceFinder::find(std::string_view uri, const fs::path& named_by) const {
  const std::string quoted = "'" + std::string(uri) + "'";
  const std::size_t colon = uri.find("://");
  const std::string_view scheme = colon == std::string_view::npos ? "" : uri.substr(0, colon);
  const std::string path = decodePercent(colon == std::string_view::npos ? uri : uri.substr(colon + 3));
  if (path.empty() || path.find('\0') != std::string::npos) {
    return failure("MeshMissing", quoted + " names no file");
  }
  for (const std::string_view name : {uri, std::string_view(path)}) {
    if (auto attachment = findAttachment(name, false)) {
      return FoundResource{{}, {}, std::move(attachment)};
    }
  }
  const auto orAttachment = [&](std::unexpected<Status> status) -> std::expected<FoundResource, Status> {
    if (auto attachment = findAttachment(path, true)) {
      return FoundResource{{}, {}, std::move(attachment)};
    }
    return status;
  };
  const auto judged = [&](const fs::path& file, const fs::path& within) -> std::expected<FoundResource, Status> {
    if (!isBeneath(file, within)) {
      return failure("PathEscapesPackage", quoted + " leads out of '" + within.string() + "'");
    }
    return isFile(file) ? std::expected<FoundResource, Status>(FoundResource{file, within})
                        : orAttachment(failure("MeshMissing", quoted + ": there is no file '" + file.string() + "'"));
  };
  if (scheme == "package" || scheme == "model") {
    const std::string package = path.substr(0, path.find('/'));
    const auto relative = fs::path(path.substr(std::min(path.size(), package.size() + 1))).lexically_normal();
    if (package.empty() || package == "." || package == ".." || relative.is_absolute() ||
        (!relative.empty() && *relative.begin() == "..")) {
      return failure("PathEscapesPackage", quoted + " leads out of its package");
    }
    const auto folder = findPackage(package, scheme == "model", named_by);
    if (!folder) {
      const std::string where = listed(paths_);
      return orAttachment(
          failure("UnknownPackage", quoted + ": there is no package '" + package + "' in " +
                                        (where.empty() ? "" : where + " or ") +
                                        "the ROS environment; --package-path FOLDER names where to look"));
    }
    return judged((*folder / relative).lexically_normal(), folder->lexically_normal());
  }
  if (!scheme.empty() && scheme != "file") {
    return failure("UnsupportedUri", quoted + ": files are read from the disk and the recording only");
  }
  fs::path file = path;
  if (scheme == "file" && !file.is_absolute()) {
    const std::size_t slash = path.find('/');  // file://localhost/...
    file = slash == std::string::npos ? fs::path(path) : fs::path(path.substr(slash));
  }
  if (file.is_absolute()) {
    file = file.lexically_normal();
    return judged(file, surroundings(file));
  }
  if (!named_by.empty()) {
    auto found = judged((named_by.parent_path() / file).lexically_normal(), surroundings(named_by));
    if (found || found.error().code == "PathEscapesPackage") {
      return found;
    }
  }
  for (const fs::path& root : paths_) {
    if (auto found = judged((root / file).lexically_normal(), root);
        found || found.error().code == "PathEscapesPackage") {
      return found;
    }
  }
  return orAttachment(failure("MeshMissing", quoted + ": there is no such file " +
                                                 (named_by.empty() ? "" : "beside '" + named_by.string() + "' ") +
                                                 "and none of that name with the recording"));
}

}  // namespace stillframe::nodes
