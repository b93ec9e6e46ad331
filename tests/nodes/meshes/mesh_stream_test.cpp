#include "nodes/meshes/mesh_stream.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace stillframe::nodes {
namespace {

MeshData triangle() {
  MeshData mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 3}};
  mesh.normals.assign(3, {0, 0, 1});
  mesh.uvs = {{0, 0}, {1, 0}, {0, 1}};
  mesh.colors = {{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}};
  mesh.indices = {0, 1, 2};
  mesh.materials = {{.name = "steel", .color = {0.5F, 0.25F, 1, 0.5F}, .texture = 0, .is_from_file = true}};
  mesh.submeshes = {{0, 3, 0}};
  mesh.textures = {{1, 2, {1, 2, 3, 4, 5, 6, 7, 8}}};
  mesh.remarks = "a texture is missing";
  updateBox(mesh);
  return mesh;
}

std::vector<std::byte> written(const MeshData& mesh) {
  std::vector<std::byte> bytes;
  writeMesh(mesh, [&](std::span<const std::byte> piece) { bytes.insert(bytes.end(), piece.begin(), piece.end()); });
  return bytes;
}

TEST(MeshStream, ReadsBackWhatWasWritten) {
  const MeshData mesh = triangle();
  const auto bytes = written(mesh);
  EXPECT_EQ(bytes.size(), streamSize(mesh));
  const auto read = readMesh(bytes);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->positions, mesh.positions);
  EXPECT_EQ(read->uvs, mesh.uvs);
  EXPECT_EQ(read->colors, mesh.colors);
  EXPECT_EQ(read->indices, mesh.indices);
  EXPECT_EQ(read->materials[0].name, "steel");
  EXPECT_EQ(read->materials[0].color, mesh.materials[0].color);
  EXPECT_EQ(read->textures[0].rgba, mesh.textures[0].rgba);
  EXPECT_EQ(read->remarks, mesh.remarks);
  EXPECT_EQ(read->high, glm::vec3(1, 2, 3));
}

TEST(MeshStream, RefusesEveryCut) {
  const auto bytes = written(triangle());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(readMesh(std::span(bytes).first(size))) << size;
  }
}

TEST(MeshStream, RefusesCountsBeyondTheBytes) {
  const auto bytes = written(triangle());
  for (std::size_t field = 1; field < 9; ++field) {
    for (const std::uint64_t value :
         {std::uint64_t{1} << 20U, std::uint64_t{1} << 33U, std::numeric_limits<std::uint64_t>::max() / 4,
          std::numeric_limits<std::uint64_t>::max()}) {
      auto changed = bytes;
      std::memcpy(changed.data() + 8 * field, &value, 8);
      EXPECT_FALSE(readMesh(changed)) << field << " " << value;
    }
  }
}

TEST(MeshStream, RefusesReferencesToWhatIsNotThere) {
  const auto errorOf = [](auto change) {
    MeshData mesh = triangle();
    change(mesh);
    const auto read = readMesh(written(mesh));
    return read ? std::string("none") : std::string(toString(read.error()));
  };
  EXPECT_EQ(errorOf([](MeshData& mesh) { mesh.indices[2] = 3; }), "BadReference");
  EXPECT_EQ(errorOf([](MeshData& mesh) { mesh.submeshes[0].first_index = 4; }), "BadReference");
  EXPECT_EQ(errorOf([](MeshData& mesh) { mesh.submeshes[0].index_count = 6; }), "BadReference");
  EXPECT_EQ(errorOf([](MeshData& mesh) { mesh.submeshes[0].index_count = 2; }), "BadReference");
  EXPECT_EQ(errorOf([](MeshData& mesh) { mesh.submeshes[0].material = 1; }), "BadReference");
  EXPECT_EQ(errorOf([](MeshData& mesh) { mesh.materials[0].texture = 1; }), "BadReference");
  EXPECT_EQ(errorOf([](MeshData& mesh) { mesh.materials[0].texture = -2; }), "BadReference");
  EXPECT_EQ(errorOf([](MeshData& mesh) { mesh.positions[1].x = std::numeric_limits<float>::infinity(); }), "BadNumber");
  EXPECT_EQ(errorOf([](MeshData& mesh) { mesh.materials[0].color[3] = std::numeric_limits<float>::quiet_NaN(); }),
            "BadNumber");
}

}  // namespace
}  // namespace stillframe::nodes
