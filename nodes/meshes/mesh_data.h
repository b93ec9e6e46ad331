#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace stillframe::nodes {

/// A decoded picture of a mesh, first row on top, sRGB-encoded.
struct MeshTexture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;
};

struct MeshMaterial {
  std::string name;
  std::array<float, 4> color{1.0F, 1.0F, 1.0F, 1.0F};  ///< sRGB-encoded, alpha linear; multiplies the texture
  std::int32_t texture = -1;                           ///< into MeshData::textures; -1: none
  bool is_from_file = false;                           ///< false: the file says nothing of its colour
  bool is_double_sided = false;
};

/// Triangles of one material: a range of MeshData::indices.
struct Submesh {
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;  ///< a multiple of 3
  std::uint32_t material = 0;
};

/// A mesh as it is drawn: metres, Z up, the transforms of its nodes applied, triangles wound counter-clockwise.
///
/// Every array of vertices is as long as `positions` or, where it says so, empty. What readMesh() accepts is
/// consistent: indices, ranges and references are within their arrays, positions finite.
struct MeshData {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> uvs;                       ///< or empty; (0, 0) is the first texel of the first row
  std::vector<std::array<std::uint8_t, 4>> colors;  ///< or empty; sRGB-encoded
  std::vector<std::uint32_t> indices;
  std::vector<Submesh> submeshes;
  std::vector<MeshMaterial> materials;
  std::vector<MeshTexture> textures;
  glm::vec3 low{0.0F};  ///< of the box of all positions; equal to high when there are none
  glm::vec3 high{0.0F};
  std::string remarks;  ///< what the file lacks for all to be shown (a texture), a sentence; "" as a rule

  [[nodiscard]] std::size_t triangleCount() const noexcept { return indices.size() / 3; }
  [[nodiscard]] std::size_t byteSize() const noexcept;
};

/// Low and high of the positions.
void updateBox(MeshData& mesh) noexcept;

}  // namespace stillframe::nodes
