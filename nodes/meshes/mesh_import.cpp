#include "nodes/meshes/mesh_import.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "nodes/images/jpeg_reader.h"
#include "nodes/images/png_reader.h"
#include "nodes/meshes/contained_files.h"
#include "nodes/primitives/triangle_area.h"

namespace stillframe::nodes {
namespace {

constexpr unsigned kSteps = aiProcess_Triangulate | aiProcess_GenNormals;
constexpr int kMaxNodeDepth = 512;
constexpr std::size_t kMaxVertices = std::size_t{1} << 28U;
constexpr std::size_t kMaxRemarks = 300;

float srgbFromLinear(float linear) {
  const float x = std::clamp(linear, 0.0F, 1.0F);
  return x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1.0F / 2.4F) - 0.055F;
}

bool isGltf(const std::string& format) { return format == "gltf" || format == "glb" || format == "vrm"; }

class Builder {
 public:
  Builder(const aiScene& scene, const ContainedFiles& files, bool are_colors_linear)
      : scene_(scene), files_(files), are_colors_linear_(are_colors_linear) {}

  std::expected<MeshData, std::string> build(const aiMatrix4x4& up) {
    const bool is_textured = std::any_of(scene_.mMeshes, scene_.mMeshes + scene_.mNumMeshes,
                                         [](const aiMesh* mesh) { return mesh->HasTextureCoords(0); });
    const bool is_colored = std::any_of(scene_.mMeshes, scene_.mMeshes + scene_.mNumMeshes,
                                        [](const aiMesh* mesh) { return mesh->HasVertexColors(0); });
    has_uvs_ = is_textured;
    has_colors_ = is_colored;
    addMaterials();
    if (scene_.mRootNode != nullptr && !addNode(*scene_.mRootNode, up, 0)) {
      return std::unexpected("its nodes repeat or nest its meshes beyond what is drawn");
    }
    if (mesh_.indices.empty() && dropped_ == 0) {
      return std::unexpected("there are no triangles in it");
    }
    if (!has_area_) {
      return std::unexpected(whyEmpty());
    }
    if (dropped_ > 0) {
      remark(std::to_string(dropped_) + " triangles have vertices that are not finite");
    }
    updateBox(mesh_);
    return std::move(mesh_);
  }

 private:
  void remark(const std::string& what) {
    if (mesh_.remarks.size() < kMaxRemarks) {
      mesh_.remarks += (mesh_.remarks.empty() ? "" : "; ") + what;
    }
  }

  /// A file of triangles none of which covers a pixel.
  [[nodiscard]] std::string whyEmpty() const {
    const std::size_t flat = mesh_.triangleCount();
    std::string why = "none of its " + std::to_string(flat + dropped_) + " triangles can be seen: ";
    why += dropped_ > 0 ? std::to_string(dropped_) + " have vertices that are not finite" : "";
    why += dropped_ > 0 && flat > 0 ? ", " : "";
    return why + (flat > 0 ? std::to_string(flat) + " have no area" : "");
  }

  [[nodiscard]] float encoded(float value) const {
    const float x = std::isfinite(value) ? std::clamp(value, 0.0F, 1.0F) : 0.0F;
    return are_colors_linear_ ? srgbFromLinear(x) : x;
  }

  void addMaterials() {
    for (unsigned i = 0; i < scene_.mNumMaterials; ++i) {
      const aiMaterial& from = *scene_.mMaterials[i];
      MeshMaterial material;
      aiString name;
      if (from.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) {
        material.name = name.C_Str();
      }
      aiColor4D color(1, 1, 1, 1);
      const bool has_base = from.Get(AI_MATKEY_BASE_COLOR, color) == aiReturn_SUCCESS;
      const bool has_diffuse = has_base || from.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS;
      aiColor4D emissive(0, 0, 0, 1);
      const bool is_black = has_diffuse && color.r + color.g + color.b <= 0.0F;
      if (is_black && from.Get(AI_MATKEY_COLOR_EMISSIVE, emissive) == aiReturn_SUCCESS) {
        color = {emissive.r, emissive.g, emissive.b, color.a};
      }
      float opacity = 1.0F;
      if (from.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS && std::isfinite(opacity)) {
        color.a = has_base ? color.a : opacity;
      }
      material.color = {encoded(color.r), encoded(color.g), encoded(color.b),
                        std::isfinite(color.a) ? std::clamp(color.a, 0.0F, 1.0F) : 1.0F};
      // assimp gives meshes without one a material of this name.
      material.is_from_file = has_diffuse && material.name != AI_DEFAULT_MATERIAL_NAME;
      if (!material.is_from_file) {
        material.color = {1.0F, 1.0F, 1.0F, 1.0F};  // assimp's own, half transparent for STL
      }
      int is_double_sided = 0;
      (void)from.Get(AI_MATKEY_TWOSIDED, is_double_sided);
      material.is_double_sided = is_double_sided != 0;
      for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
        aiString path;
        if (material.texture < 0 && from.GetTexture(type, 0, &path) == aiReturn_SUCCESS) {
          material.texture = texture(path.C_Str());
          material.is_from_file = material.is_from_file || material.texture >= 0;
          if (material.texture >= 0 && is_black) {
            material.color = {1.0F, 1.0F, 1.0F, material.color[3]};  // the texture stands in for the colour
          }
        }
      }
      mesh_.materials.push_back(std::move(material));
    }
    if (mesh_.materials.empty()) {
      mesh_.materials.emplace_back();
    }
  }

  /// Index of a texture, decoded once; -1 when it cannot be.
  std::int32_t texture(const std::string& path) {
    const auto [known, is_new] = textures_.try_emplace(path, -1);
    if (!is_new) {
      return known->second;
    }
    auto decoded = decode(path);
    if (!decoded) {
      remark("texture '" + path + "' " + decoded.error());
      return -1;
    }
    known->second = static_cast<std::int32_t>(mesh_.textures.size());
    mesh_.textures.push_back(std::move(*decoded));
    return known->second;
  }

  [[nodiscard]] std::expected<MeshTexture, std::string> decode(const std::string& path) const {
    const aiTexture* const embedded = scene_.GetEmbeddedTexture(path.c_str());
    if (embedded != nullptr && embedded->mHeight > 0) {
      return rawTexture(*embedded);
    }
    std::vector<std::byte> read;
    std::span<const std::byte> bytes;
    if (embedded != nullptr) {
      bytes = std::as_bytes(std::span(reinterpret_cast<const char*>(embedded->pcData), embedded->mWidth));
    } else {
      auto file = files_.read(path);
      if (!file) {
        return std::unexpected("is not there");
      }
      read = std::move(*file);
      bytes = read;
    }
    if (isPng(bytes)) {
      auto png = readRgbaPng(bytes);
      return png ? std::expected<MeshTexture, std::string>(MeshTexture{png->width, png->height, std::move(png->rgba)})
                 : std::unexpected(png.error().message);
    }
    auto jpeg = readJpeg(bytes);
    return jpeg ? std::expected<MeshTexture, std::string>(MeshTexture{jpeg->width, jpeg->height, std::move(jpeg->rgba)})
                : std::unexpected("is neither PNG nor JPEG");
  }

  static std::expected<MeshTexture, std::string> rawTexture(const aiTexture& from) {
    constexpr unsigned kMaxSide = 16384;
    if (from.mWidth > kMaxSide || from.mHeight > kMaxSide) {
      return std::unexpected("is too large");
    }
    MeshTexture texture{from.mWidth, from.mHeight, {}};
    const std::size_t texels = std::size_t{from.mWidth} * from.mHeight;
    texture.rgba.reserve(4 * texels);
    for (std::size_t i = 0; i < texels; ++i) {
      const aiTexel& texel = from.pcData[i];
      texture.rgba.insert(texture.rgba.end(), {texel.r, texel.g, texel.b, texel.a});
    }
    return texture;
  }

  bool addNode(const aiNode& node, const aiMatrix4x4& parent, int depth) {
    const aiMatrix4x4 world = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      if (node.mMeshes[i] < scene_.mNumMeshes && !addMesh(*scene_.mMeshes[node.mMeshes[i]], world)) {
        return false;
      }
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      if (depth >= kMaxNodeDepth || !addNode(*node.mChildren[i], world, depth + 1)) {
        return false;
      }
    }
    return true;
  }

  bool addMesh(const aiMesh& from, const aiMatrix4x4& world) {
    const std::size_t first = mesh_.positions.size();
    if (from.mNumVertices > kMaxVertices - first) {
      return false;
    }
    addVertices(from, world);
    Submesh submesh{.first_index = static_cast<std::uint32_t>(mesh_.indices.size()),
                    .material = std::min(from.mMaterialIndex, static_cast<unsigned>(mesh_.materials.size() - 1))};
    const bool is_mirrored = world.Determinant() < 0;
    const auto isFinite = [&](unsigned i) {
      const glm::vec3& p = mesh_.positions[first + i];
      return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    };
    for (unsigned i = 0; i < from.mNumFaces; ++i) {
      const aiFace& face = from.mFaces[i];
      if (face.mNumIndices != 3 ||
          std::any_of(face.mIndices, face.mIndices + 3, [&](unsigned index) { return index >= from.mNumVertices; })) {
        continue;
      }
      if (!isFinite(face.mIndices[0]) || !isFinite(face.mIndices[1]) || !isFinite(face.mIndices[2])) {
        ++dropped_;
        continue;
      }
      if (!has_area_) {
        const auto corner = [&](int k) { return glm::dvec3(mesh_.positions[first + face.mIndices[k]]); };
        has_area_ = hasArea(corner(0), corner(1), corner(2));
      }
      const auto base = static_cast<std::uint32_t>(first);
      mesh_.indices.push_back(base + face.mIndices[0]);
      mesh_.indices.push_back(base + face.mIndices[is_mirrored ? 2 : 1]);
      mesh_.indices.push_back(base + face.mIndices[is_mirrored ? 1 : 2]);
    }
    for (std::size_t i = first; i < mesh_.positions.size(); ++i) {
      if (!isFinite(static_cast<unsigned>(i - first))) {
        mesh_.positions[i] = glm::vec3(0.0F);  // of no triangle
      }
    }
    submesh.index_count = static_cast<std::uint32_t>(mesh_.indices.size() - submesh.first_index);
    if (submesh.index_count > 0) {
      mesh_.submeshes.push_back(submesh);
    }
    return true;
  }

  void addVertices(const aiMesh& from, const aiMatrix4x4& world) {
    aiMatrix3x3 normals = aiMatrix3x3(world);
    normals.Inverse().Transpose();
    for (unsigned i = 0; i < from.mNumVertices; ++i) {
      const aiVector3D at = world * from.mVertices[i];
      mesh_.positions.emplace_back(at.x, at.y, at.z);
      const aiVector3D turned = from.HasNormals() ? normals * from.mNormals[i] : aiVector3D(0, 0, 1);
      const glm::vec3 normal(turned.x, turned.y, turned.z);
      const float length = glm::length(normal);
      mesh_.normals.push_back(length > 0.0F && std::isfinite(length) ? normal / length : glm::vec3(0, 0, 1));
      if (has_uvs_) {
        const aiVector3D uv = from.HasTextureCoords(0) ? from.mTextureCoords[0][i] : aiVector3D();
        const bool is_good = std::isfinite(uv.x) && std::isfinite(uv.y);
        mesh_.uvs.emplace_back(is_good ? uv.x : 0.0F, is_good ? 1.0F - uv.y : 0.0F);  // assimp's origin is the last row
      }
      if (has_colors_) {
        const aiColor4D color = from.HasVertexColors(0) ? from.mColors[0][i] : aiColor4D(1, 1, 1, 1);
        const auto byte = [](float x) { return static_cast<std::uint8_t>(std::lround(255.0F * x)); };
        mesh_.colors.push_back({byte(encoded(color.r)), byte(encoded(color.g)), byte(encoded(color.b)),
                                byte(std::isfinite(color.a) ? std::clamp(color.a, 0.0F, 1.0F) : 1.0F)});
      }
    }
  }

  const aiScene& scene_;
  const ContainedFiles& files_;
  bool are_colors_linear_;
  bool has_uvs_ = false;
  bool has_colors_ = false;
  std::map<std::string, std::int32_t> textures_;
  std::size_t dropped_ = 0;
  bool has_area_ = false;  // of any triangle
  MeshData mesh_;
};

/// Y up to Z up: +90 degrees about X.
aiMatrix4x4 zUpFromYUp() { return {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1}; }

}  // namespace

std::expected<MeshData, std::string> importMesh(const MeshImport& import) {
  const std::filesystem::path name = (import.file.empty() ? "mesh" : import.file.stem().string()) + "." + import.format;
  // The importer owns the file system it is given.
  auto* const files = new ContainedFiles(import.bytes, name, import.file.parent_path(), import.within);
  Assimp::Importer importer;
  importer.SetIOHandler(files);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, !import.use_collada_up_axis);
  const aiScene* const scene = importer.ReadFile(name.string(), kSteps);
  if (scene == nullptr) {
    std::string why = importer.GetErrorString();
    return std::unexpected(why.empty() ? "the importer gives no reason" : std::move(why));
  }
  const bool is_collada = import.format == "dae" || import.format == "zae";
  const bool is_y_up = isGltf(import.format) || (is_collada && import.use_collada_up_axis);
  return Builder(*scene, *files, isGltf(import.format)).build(is_y_up ? zUpFromYUp() : aiMatrix4x4());
}

}  // namespace stillframe::nodes
