// What the importing process hands back, from the fuzzer: what is accepted must be consistent in every reference.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "nodes/meshes/mesh_stream.h"

namespace {

using namespace stillframe;

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A copy of exactly the size, so that one byte too many is caught.
  std::vector<std::byte> bytes(size);
  if (size > 0) {
    std::memcpy(bytes.data(), data, size);
  }
  const auto mesh = nodes::readMesh(bytes);
  if (!mesh) {
    return 0;
  }
  require(mesh->normals.size() == mesh->positions.size());
  require(mesh->uvs.empty() || mesh->uvs.size() == mesh->positions.size());
  require(mesh->colors.empty() || mesh->colors.size() == mesh->positions.size());
  for (const std::uint32_t index : mesh->indices) {
    require(index < mesh->positions.size());
  }
  for (const nodes::Submesh& submesh : mesh->submeshes) {
    require(std::size_t{submesh.first_index} + submesh.index_count <= mesh->indices.size());
    require(submesh.material < mesh->materials.size());
  }
  for (const nodes::MeshTexture& texture : mesh->textures) {
    require(texture.rgba.size() == std::size_t{4} * texture.width * texture.height);
  }
  require(std::isfinite(mesh->low.x) && std::isfinite(mesh->high.z));
  require(nodes::streamSize(*mesh) == size);
  return 0;
}
