#include "nodes/meshes/mesh_stream.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <type_traits>

namespace stillframe::nodes {
namespace {

constexpr std::uint64_t kMagic = 0x314853454d465331ULL;  // "1SFMESH1"
constexpr std::uint32_t kMaxTextureSide = 16384;
constexpr std::uint64_t kMaxCount = std::uint64_t{1} << 32U;  // of anything: sums of products stay below 2^64

struct StreamHeader {
  std::uint64_t magic = kMagic;
  std::uint64_t vertices = 0;
  std::uint64_t indices = 0;
  std::uint64_t submeshes = 0;
  std::uint64_t materials = 0;
  std::uint64_t textures = 0;
  std::uint64_t remark_bytes = 0;
  std::uint64_t has_uvs = 0;
  std::uint64_t has_colors = 0;
};
struct StreamMaterial {
  std::array<float, 4> color{};
  std::int32_t texture = -1;
  std::uint32_t is_from_file = 0;
  std::uint32_t is_double_sided = 0;
  std::uint32_t name_bytes = 0;
};
struct StreamTexture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// Takes values off the head of bytes.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}
  template <typename T>
  bool value(T& out) {
    return array(std::span(&out, 1));
  }
  template <typename T>
  bool vector(std::vector<T>& out, std::uint64_t count) {
    if (count > rest_.size() / sizeof(T)) {
      return false;
    }
    out.resize(count);
    return array(std::span(out));
  }
  bool text(std::string& out, std::uint64_t count) {
    if (count > rest_.size()) {
      return false;
    }
    out.assign(reinterpret_cast<const char*>(rest_.data()), count);
    rest_ = rest_.subspan(count);
    return true;
  }
  [[nodiscard]] bool isAtEnd() const { return rest_.empty(); }

 private:
  template <typename T>
  bool array(std::span<T> out) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (out.size_bytes() > rest_.size()) {
      return false;
    }
    if (!out.empty()) {
      std::memcpy(out.data(), rest_.data(), out.size_bytes());
    }
    rest_ = rest_.subspan(out.size_bytes());
    return true;
  }
  std::span<const std::byte> rest_;
};

template <typename T>
std::span<const std::byte> bytesOf(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}

bool readLists(Reader& reader, const StreamHeader& header, MeshData& mesh) {
  if (!reader.vector(mesh.submeshes, header.submeshes)) {
    return false;
  }
  for (std::uint64_t i = 0; i < header.materials; ++i) {
    StreamMaterial record;
    MeshMaterial material;
    if (!reader.value(record) || !reader.text(material.name, record.name_bytes)) {
      return false;
    }
    material.color = record.color;
    material.texture = record.texture;
    material.is_from_file = record.is_from_file != 0;
    material.is_double_sided = record.is_double_sided != 0;
    mesh.materials.push_back(std::move(material));
  }
  for (std::uint64_t i = 0; i < header.textures; ++i) {
    StreamTexture record;
    MeshTexture texture;
    if (!reader.value(record) || record.width > kMaxTextureSide || record.height > kMaxTextureSide ||
        !reader.vector(texture.rgba, std::uint64_t{4} * record.width * record.height)) {
      return false;
    }
    texture.width = record.width;
    texture.height = record.height;
    mesh.textures.push_back(std::move(texture));
  }
  return true;
}

bool areReferencesGood(const MeshData& mesh) {
  const auto vertices = mesh.positions.size();
  const bool are_indices_good = mesh.indices.empty() || *std::ranges::max_element(mesh.indices) < vertices;
  const auto isRangeGood = [&](const Submesh& submesh) {
    return submesh.index_count % 3 == 0 && submesh.first_index <= mesh.indices.size() &&
           submesh.index_count <= mesh.indices.size() - submesh.first_index && submesh.material < mesh.materials.size();
  };
  const auto isMaterialGood = [&](const MeshMaterial& material) {
    return material.texture >= -1 && material.texture < static_cast<std::int64_t>(mesh.textures.size());
  };
  return are_indices_good && mesh.indices.size() % 3 == 0 && std::ranges::all_of(mesh.submeshes, isRangeGood) &&
         std::ranges::all_of(mesh.materials, isMaterialGood);
}

bool areNumbersGood(const MeshData& mesh) {
  const auto isFinite = [](const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  const auto isColor = [](const MeshMaterial& material) {
    return std::ranges::all_of(material.color, [](float x) { return x >= 0.0F && x <= 1.0F; });
  };
  return std::ranges::all_of(mesh.positions, isFinite) && std::ranges::all_of(mesh.normals, isFinite) &&
         std::ranges::all_of(mesh.materials, isColor);
}

}  // namespace

std::string_view toString(MeshStreamError error) noexcept {
  switch (error) {
    case MeshStreamError::NotAMesh:
      return "NotAMesh";
    case MeshStreamError::WrongSize:
      return "WrongSize";
    case MeshStreamError::BadReference:
      return "BadReference";
    case MeshStreamError::BadNumber:
      return "BadNumber";
  }
  return "";
}

void writeMesh(const MeshData& mesh, const std::function<void(std::span<const std::byte>)>& put) {
  const StreamHeader header{.vertices = mesh.positions.size(),
                            .indices = mesh.indices.size(),
                            .submeshes = mesh.submeshes.size(),
                            .materials = mesh.materials.size(),
                            .textures = mesh.textures.size(),
                            .remark_bytes = mesh.remarks.size(),
                            .has_uvs = mesh.uvs.empty() ? 0U : 1U,
                            .has_colors = mesh.colors.empty() ? 0U : 1U};
  put(bytesOf(header));
  put(std::as_bytes(std::span(mesh.positions)));
  put(std::as_bytes(std::span(mesh.normals)));
  put(std::as_bytes(std::span(mesh.uvs)));
  put(std::as_bytes(std::span(mesh.colors)));
  put(std::as_bytes(std::span(mesh.indices)));
  put(std::as_bytes(std::span(mesh.submeshes)));
  for (const MeshMaterial& material : mesh.materials) {
    put(bytesOf(StreamMaterial{.color = material.color,
                               .texture = material.texture,
                               .is_from_file = material.is_from_file ? 1U : 0U,
                               .is_double_sided = material.is_double_sided ? 1U : 0U,
                               .name_bytes = static_cast<std::uint32_t>(material.name.size())}));
    put(std::as_bytes(std::span(material.name)));
  }
  for (const MeshTexture& texture : mesh.textures) {
    put(bytesOf(StreamTexture{texture.width, texture.height}));
    put(std::as_bytes(std::span(texture.rgba)));
  }
  put(std::as_bytes(std::span(mesh.remarks)));
}

std::size_t streamSize(const MeshData& mesh) {
  std::size_t bytes = 0;
  writeMesh(mesh, [&](std::span<const std::byte> piece) { bytes += piece.size(); });
  return bytes;
}

std::expected<MeshData, MeshStreamError> readMesh(std::span<const std::byte> bytes) {
  Reader reader(bytes);
  StreamHeader header;
  if (!reader.value(header) || header.magic != kMagic || header.has_uvs > 1 || header.has_colors > 1) {
    return std::unexpected(MeshStreamError::NotAMesh);
  }
  for (const std::uint64_t count :
       {header.vertices, header.indices, header.submeshes, header.materials, header.textures, header.remark_bytes}) {
    if (count >= kMaxCount) {
      return std::unexpected(MeshStreamError::WrongSize);
    }
  }
  MeshData mesh;
  if (!reader.vector(mesh.positions, header.vertices) || !reader.vector(mesh.normals, header.vertices) ||
      !reader.vector(mesh.uvs, header.has_uvs * header.vertices) ||
      !reader.vector(mesh.colors, header.has_colors * header.vertices) ||
      !reader.vector(mesh.indices, header.indices) || !readLists(reader, header, mesh) ||
      !reader.text(mesh.remarks, header.remark_bytes) || !reader.isAtEnd()) {
    return std::unexpected(MeshStreamError::WrongSize);
  }
  if (!areReferencesGood(mesh)) {
    return std::unexpected(MeshStreamError::BadReference);
  }
  if (!areNumbersGood(mesh)) {
    return std::unexpected(MeshStreamError::BadNumber);
  }
  updateBox(mesh);
  return mesh;
}

}  // namespace stillframe::nodes
