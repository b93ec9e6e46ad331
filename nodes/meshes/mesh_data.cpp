#include "nodes/meshes/mesh_data.h"

#include <glm/common.hpp>

namespace stillframe::nodes {

std::size_t MeshData::byteSize() const noexcept {
  std::size_t bytes = sizeof(*this) + positions.size() * sizeof(glm::vec3) + normals.size() * sizeof(glm::vec3) +
                      uvs.size() * sizeof(glm::vec2) + colors.size() * 4 + indices.size() * 4 +
                      submeshes.size() * sizeof(Submesh) + materials.size() * sizeof(MeshMaterial);
  for (const MeshTexture& texture : textures) {
    bytes += texture.rgba.size();
  }
  return bytes;
}

void updateBox(MeshData& mesh) noexcept {
  mesh.low = mesh.high = mesh.positions.empty() ? glm::vec3(0.0F) : mesh.positions.front();
  for (const glm::vec3& position : mesh.positions) {
    mesh.low = glm::min(mesh.low, position);
    mesh.high = glm::max(mesh.high, position);
  }
}

}  // namespace stillframe::nodes
