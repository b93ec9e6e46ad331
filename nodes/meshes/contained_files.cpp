#include "nodes/meshes/contained_files.h"

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

namespace stillframe::nodes {
namespace {

constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{1} << 30U;

/// A file in memory.
class MemoryFile final : public Assimp::IOStream {
 public:
  explicit MemoryFile(std::span<const std::byte> bytes) : bytes_(bytes) {}
  explicit MemoryFile(std::vector<std::byte> owned) : owned_(std::move(owned)), bytes_(owned_) {}

  std::size_t Read(void* out, std::size_t size, std::size_t count) override {
    const std::size_t items = size == 0 ? 0 : std::min(count, (bytes_.size() - at_) / size);
    if (items > 0) {
      std::memcpy(out, bytes_.data() + at_, items * size);
    }
    at_ += items * size;
    return items;
  }
  std::size_t Write(const void* /*bytes*/, std::size_t /*size*/, std::size_t /*count*/) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    // Offsets from the end come as wrapped negative numbers.
    const std::size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : bytes_.size();
    const std::size_t to = base + offset;
    if (to > bytes_.size()) {
      return aiReturn_FAILURE;
    }
    at_ = to;
    return aiReturn_SUCCESS;
  }
  [[nodiscard]] std::size_t Tell() const override { return at_; }
  [[nodiscard]] std::size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

 private:
  std::vector<std::byte> owned_;
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

bool isBeneath(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const auto relative = file.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

ContainedFiles::ContainedFiles(std::span<const std::byte> mesh, std::filesystem::path mesh_name,
                               std::filesystem::path folder, const std::filesystem::path& within)
    : mesh_(mesh),
      mesh_name_(std::move(mesh_name)),
      folder_(std::move(folder)),
      within_(within.empty() ? within : within.lexically_normal()) {}

std::optional<std::filesystem::path> ContainedFiles::find(const std::string& name) const {
  if (folder_.empty() || name.find('\0') != std::string::npos) {
    return std::nullopt;
  }
  std::string clean = name;
  std::ranges::replace(clean, '\\', '/');
  const std::filesystem::path path = clean;
  const auto isFile = [](const std::filesystem::path& file) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(file, ignored);
  };
  auto asked = (folder_ / path).lexically_normal();
  if (!path.is_absolute() && isBeneath(asked, within_) && isFile(asked)) {
    return asked;
  }
  const auto beside = folder_ / path.filename();
  return !path.filename().empty() && isFile(beside) ? std::optional(beside) : std::nullopt;
}

std::optional<std::vector<std::byte>> ContainedFiles::read(const std::string& name) const {
  const auto file = find(name);
  std::error_code error;
  const auto size = file ? std::filesystem::file_size(*file, error) : 0;
  if (!file || error || size > kMaxFileBytes) {
    return std::nullopt;
  }
  std::vector<std::byte> bytes(size);
  std::ifstream stream(*file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  return stream ? std::optional(std::move(bytes)) : std::nullopt;
}

bool ContainedFiles::Exists(const char* name) const { return isMesh(name) || find(name).has_value(); }

Assimp::IOStream* ContainedFiles::Open(const char* name, const char* mode) {
  if (std::strpbrk(mode, "wa+") != nullptr) {
    return nullptr;
  }
  if (isMesh(name)) {
    return new MemoryFile(mesh_);  // Close() deletes it: assimp's own contract
  }
  auto bytes = read(name);
  return bytes ? new MemoryFile(std::move(*bytes)) : nullptr;
}

void ContainedFiles::Close(Assimp::IOStream* stream) { delete stream; }

}  // namespace stillframe::nodes
