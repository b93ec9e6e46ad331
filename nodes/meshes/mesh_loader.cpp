#include "nodes/meshes/mesh_loader.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <exception>
#include <fstream>
#include <functional>
#include <system_error>
#include <thread>
#include <utility>

#include "nodes/meshes/attached_folder.h"
#include "nodes/meshes/import_process.h"

namespace stillframe::nodes {
namespace {

using scenegraph::failure;
using scenegraph::Status;
using scenegraph::StatusLevel;

constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{2} << 30U;

/// What the cache keeps: a mesh, or why there is none.
struct ImportOutcome {
  MeshLoader::Loaded loaded;
};

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

std::expected<std::vector<std::byte>, Status> readFile(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error || !stream) {
    return failure("MeshMissing", "'" + file.string() + "' cannot be opened");
  }
  if (size > kMaxFileBytes) {
    return failure("MeshTooLarge", "'" + file.string() + "' has " + std::to_string(size) + " bytes, at most " +
                                       std::to_string(kMaxFileBytes) + " are read");
  }
  std::vector<std::byte> bytes(size);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  return bytes;
}

/// Whether a file of that format holds all that is drawn.
bool isSelfContained(std::string_view format) { return format == "stl" || format == "glb" || format == "ply"; }

}  // namespace

std::string meshFormat(std::string_view ending_or_media_type, std::span<const std::byte> bytes) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kMediaTypes{
      {{"model/gltf-binary", "glb"},
       {"model/gltf+json", "gltf"},
       {"model/stl", "stl"},
       {"model/x.stl-binary", "stl"},
       {"model/x.stl-ascii", "stl"},
       {"application/sla", "stl"},
       {"application/vnd.ms-pki.stl", "stl"},
       {"model/obj", "obj"},
       {"model/ply", "ply"},
       {"application/ply", "ply"},
       {"model/vnd.collada+xml", "dae"},
       {"model/x-ply", "ply"}}};
  std::string text = lower(ending_or_media_type.substr(0, ending_or_media_type.find(';')));
  if (text.starts_with('.')) {
    text.erase(0, 1);
  }
  for (const auto& [media_type, format] : kMediaTypes) {
    if (text == media_type) {
      return std::string(format);
    }
  }
  const bool is_ending = !text.empty() && text.size() <= 8 &&
                         std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) != 0; });
  if (is_ending) {
    return text;
  }
  const std::string_view head(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 1024));
  if (head.starts_with("glTF")) {
    return "glb";
  }
  if (head.starts_with("ply")) {
    return "ply";
  }
  if (head.find("<COLLADA") != std::string_view::npos) {
    return "dae";
  }
  if (head.find("\"asset\"") != std::string_view::npos) {
    return "gltf";
  }
  std::uint32_t triangles = 0;
  constexpr std::size_t kStlHeader = 84;
  if (bytes.size() >= kStlHeader) {
    std::copy_n(bytes.begin() + 80, 4, reinterpret_cast<std::byte*>(&triangles));
  }
  const bool is_binary_stl = bytes.size() >= kStlHeader && bytes.size() == kStlHeader + 50 * std::uint64_t{triangles};
  return is_binary_stl || head.starts_with("solid") ? "stl" : "";
}

MeshLoader::Loaded MeshLoader::load(const std::string& uri, const std::filesystem::path& named_by,
                                    const MeshOptions& options) const {
  const auto found = finder_.find(uri, named_by);
  if (!found) {
    return std::unexpected(found.error());
  }
  const std::filesystem::path name = found->attachment ? found->attachment->name : found->file.string();
  if (found->attachment) {
    const auto payload = found->attachment->read();
    return payload ? import(payload->bytes, meshFormat(name.extension().string(), payload->bytes), *found, options)
                   : failure("MeshMissing", "the attachment '" + name.string() + "': " + payload.error());
  }
  const auto bytes = readFile(found->file);
  return bytes ? import(*bytes, meshFormat(name.extension().string(), *bytes), *found, options)
               : std::unexpected(bytes.error());
}

std::expected<std::vector<std::byte>, Status> MeshLoader::read(const std::string& uri,
                                                               const std::filesystem::path& named_by) const {
  const auto found = finder_.find(uri, named_by);
  if (!found) {
    return std::unexpected(found.error());
  }
  if (!found->attachment) {
    return readFile(found->file);
  }
  const auto payload = found->attachment->read();
  return payload ? std::expected<std::vector<std::byte>, Status>(
                       std::vector<std::byte>(payload->bytes.begin(), payload->bytes.end()))
                 : failure("MeshMissing", "the attachment '" + found->attachment->name + "': " + payload.error());
}

std::vector<MeshLoader::Loaded> MeshLoader::loadAll(std::span<const std::string> uris,
                                                    const std::filesystem::path& named_by,
                                                    const MeshOptions& options) const {
  std::vector<Loaded> loaded(uris.size(), failure("MeshMissing", "not loaded"));
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < uris.size(); i = next++) {
      try {
        loaded[i] = load(uris[i], named_by, options);
      } catch (const std::exception& error) {  // out of memory: on a thread of our own nobody else would catch it
        loaded[i] = failure("MeshTooLarge", "'" + uris[i] + "' cannot be loaded: " + error.what());
      }
    }
  };
  const std::size_t cores = std::clamp(std::thread::hardware_concurrency(), 1U, 4U);
  std::vector<std::jthread> helpers;
  for (std::size_t i = 1; i < std::min(cores, uris.size()); ++i) {
    helpers.emplace_back(work);
  }
  work();
  helpers.clear();  // joins
  return loaded;
}

MeshLoader::Loaded MeshLoader::loadBytes(std::span<const std::byte> bytes, std::string_view format,
                                         const MeshOptions& options) const {
  return import(bytes, meshFormat(format, bytes), {}, options);
}

MeshLoader::Loaded MeshLoader::import(std::span<const std::byte> bytes, const std::string& format,
                                      const FoundResource& from, const MeshOptions& options) const {
  const std::string_view content(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  scenegraph::CacheKey key{.topic = ~scenegraph::TopicId{0},  // of no topic
                           .log_time_ns = static_cast<std::int64_t>(std::hash<std::string_view>{}(content)),
                           .payload_bytes = bytes.size(),
                           .product = "mesh " + format + (options.use_collada_up_axis ? " up " : " ")};
  if (!isSelfContained(format)) {
    key.product += from.attachment ? from.attachment->name : from.file.string();
  }
  const auto named = [&](const Loaded& loaded) -> Loaded {
    const std::string name = from.attachment     ? "the attachment '" + from.attachment->name + "'"
                             : from.file.empty() ? std::string("the mesh in the message")
                                                 : "'" + from.file.string() + "'";
    return loaded ? loaded : failure(loaded.error().code, name + ": " + loaded.error().message);
  };
  if (const auto known = cache_.get<ImportOutcome>(key)) {
    return named(known->loaded);
  }
  Loaded loaded = failure("MeshUnreadable", "of what format it is cannot be told");
  if (!format.empty()) {
    const AttachedFolder folder =
        from.attachment && !isSelfContained(format) ? finder_.folderOf(*from.attachment) : AttachedFolder{};
    auto mesh = importInProcess({.bytes = bytes,
                                 .format = format,
                                 .file = folder.path().empty() ? from.file : folder.fileOf(*from.attachment),
                                 .within = folder.path().empty() ? from.within : folder.path(),
                                 .use_collada_up_axis = options.use_collada_up_axis,
                                 .limits = importLimits(bytes.size())});
    loaded = mesh ? Loaded(std::make_shared<const MeshData>(std::move(*mesh))) : std::unexpected(mesh.error());
  }
  const auto outcome = std::make_shared<const ImportOutcome>(ImportOutcome{loaded});
  cache_.put(key, outcome, sizeof(ImportOutcome) + (loaded ? (*loaded)->byteSize() : loaded.error().message.size()));
  return named(loaded);
}

}  // namespace stillframe::nodes
