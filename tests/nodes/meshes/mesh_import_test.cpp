// Formats, through the importing process.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>

#include "nodes/meshes/mesh_loader.h"
#include "tests/nodes/meshes/mesh_files.h"

namespace stillframe::nodes {
namespace {

using test::bytesOf;

class MeshFormats : public ::testing::Test {
 protected:
  MeshLoader::Loaded load(std::string_view bytes, std::string_view format, const MeshOptions& options = {}) {
    return loader_.loadBytes(bytesOf(bytes), format, options);
  }
  scenegraph::ObjectCache cache_;
  scenegraph::Resources resources_;
  MeshLoader loader_{cache_, resources_};
};

void expectNear(const glm::vec3& a, const glm::vec3& b) {
  EXPECT_LT(glm::length(a - b), 1e-6F) << a.x << " " << a.y << " " << a.z;
}

TEST_F(MeshFormats, StlIsMetresAsItIs) {
  const auto mesh = load(test::kStl, "stl");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ((*mesh)->triangleCount(), 1U);
  expectNear((*mesh)->high, {1, 2, 3});
  EXPECT_FALSE((*mesh)->materials[0].is_from_file);
  EXPECT_EQ((*mesh)->materials[0].color, (std::array<float, 4>{1, 1, 1, 1}));
}

TEST_F(MeshFormats, PlyKeepsColoursOfItsVertices) {
  const auto mesh = load(test::kPly, "");
  ASSERT_TRUE(mesh) << mesh.error().message;
  expectNear((*mesh)->high, {1, 2, 3});
  ASSERT_EQ((*mesh)->colors.size(), 3U);
  EXPECT_EQ((*mesh)->colors[2], (std::array<std::uint8_t, 4>{0, 0, 128, 255}));
}

TEST_F(MeshFormats, ColladaIsScaledByItsUnitAndItsUpAxisIgnoredUnlessAsked) {
  const auto as_is = load(test::collada("0.01", "Y_UP"), "model/vnd.collada+xml");
  ASSERT_TRUE(as_is) << as_is.error().message;
  expectNear((*as_is)->high, {0.01F, 0.02F, 0.03F});
  EXPECT_EQ((*as_is)->materials.at((*as_is)->submeshes[0].material).color, (std::array<float, 4>{0.5F, 0.25F, 1, 1}));
  const auto turned = load(test::collada("0.01", "Y_UP"), "dae", {.use_collada_up_axis = true});
  ASSERT_TRUE(turned);
  expectNear((*turned)->high, {0.01F, 0, 0.02F});
  expectNear((*turned)->low, {0, -0.03F, 0});
  const auto z_up = load(test::collada("1", "Z_UP"), "dae", {.use_collada_up_axis = true});
  ASSERT_TRUE(z_up);
  expectNear((*z_up)->high, {1, 2, 3});
}

TEST_F(MeshFormats, GltfIsTurnedToZUpAndItsLinearColourEncoded) {
  const auto mesh = load(test::kGltf, "gltf");
  ASSERT_TRUE(mesh) << mesh.error().message;
  expectNear((*mesh)->low, {0, -3, 0});
  expectNear((*mesh)->high, {1, 0, 2});
  const MeshMaterial& material = (*mesh)->materials.at((*mesh)->submeshes[0].material);
  EXPECT_NEAR(material.color[0], 0.5F, 1e-3F);  // 0.2140411 linear
  EXPECT_NEAR(material.color[3], 0.25F, 1e-6F);
  EXPECT_TRUE(material.is_double_sided);
}

TEST_F(MeshFormats, MirroredNodesKeepTheirTrianglesOutside) {
  const auto mesh = load(test::collada("1", "Z_UP", "-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"), "dae");
  ASSERT_TRUE(mesh) << mesh.error().message;
  expectNear((*mesh)->low, {-1, 0, 0});
  const auto at = [&](std::size_t i) { return (*mesh)->positions[(*mesh)->indices[i]]; };
  const glm::vec3 by_winding = glm::cross(at(1) - at(0), at(2) - at(0));
  EXPECT_GT(glm::dot(by_winding, (*mesh)->normals[0]), 0.0F);
  EXPECT_LT((*mesh)->normals[0].y, 0.0F);  // (0,-3,2) of the plain one
}

TEST_F(MeshFormats, ObjTakesItsMaterialsFromBesideIt) {
  const test::FilesFolder files;
  files.add("pkg/meshes/t.mtl", test::kMtl);
  const auto mesh = loader_.load(files.add("pkg/meshes/t.obj", test::kObj).string());
  ASSERT_TRUE(mesh) << mesh.error().message;
  expectNear((*mesh)->high, {1, 2, 3});
  EXPECT_EQ((*mesh)->materials.at((*mesh)->submeshes[0].material).color, (std::array<float, 4>{1, 0, 0.2F, 0.5F}));
}

TEST_F(MeshFormats, TrianglesThatAreNotFiniteAreLeftOutAndCounted) {
  std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nf 1 2 3\nf 1 2 4\n";
  const auto mesh = load(obj, "obj");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ((*mesh)->triangleCount(), 1U);
  EXPECT_NE((*mesh)->remarks.find("1 triangles"), std::string::npos) << (*mesh)->remarks;
}

TEST_F(MeshFormats, TrianglesOfWhichNoneCanBeSeenAreNoMesh) {
  const std::string corners = "v 0 0 0\nv 1e-5 0 0\nv 0 1e-5 0\nv 3e-5 0 0\nv nan 0 0\n";
  const auto refusal = [&](const std::string& faces) {
    const auto mesh = load(corners + faces, "obj");
    return mesh ? std::string("it is drawn") : mesh.error().message;
  };
  const auto has = [](const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; };
  const std::string on_a_line = refusal("f 1 2 4\nf 1 4 2\n");
  EXPECT_TRUE(has(on_a_line, "none of its 2 triangles can be seen: 2 have no area")) << on_a_line;
  const std::string mixed = refusal("f 1 2 5\nf 1 2 4\n");
  EXPECT_TRUE(has(mixed, "1 have vertices that are not finite, 1 have no area")) << mixed;
  const std::string nowhere = refusal("f 1 2 5\n");
  EXPECT_TRUE(has(nowhere, "1 have vertices that are not finite")) << nowhere;
  EXPECT_EQ(refusal("f 1 2 4\nf 1 2 3\n"), "it is drawn") << "however small";
}

TEST_F(MeshFormats, FilesOutsideOfThePackageAreNotRead) {
  const test::FilesFolder files;
  files.add("secret.mtl", test::kMtl);
  files.add("pkg/package.xml", "<package><name>pkg</name></package>");
  const auto file =
      files.add("pkg/meshes/t.obj", "mtllib ../../secret.mtl\nv 0 0 0\nv 1 0 0\nv 0 2 3\nusemtl red\nf 1 2 3\n");
  const auto mesh = loader_.load(file.string());
  ASSERT_TRUE(mesh) << mesh.error().message;
  for (const MeshMaterial& material : (*mesh)->materials) {
    EXPECT_NE(material.color, (std::array<float, 4>{1, 0, 0.2F, 0.5F}));
  }
}

TEST_F(MeshFormats, EqualContentIsImportedOnceAndSoIsAFailure) {
  const auto first = load(test::kStl, "stl");
  const auto second = load(test::kStl, "model/stl");
  ASSERT_TRUE(first);
  EXPECT_EQ(first->get(), second->get());
  EXPECT_FALSE(load("no mesh", "stl"));
  const auto misses = cache_.misses();
  EXPECT_FALSE(load("no mesh", "stl"));
  EXPECT_EQ(cache_.misses(), misses);
}

TEST_F(MeshFormats, WhatIsNoMeshSaysWhy) {
  EXPECT_EQ(load("", "stl").error().code, "MeshUnreadable");
  EXPECT_EQ(load("hello", "").error().code, "MeshUnreadable");
  EXPECT_EQ(load("hello", "obj").error().code, "MeshUnreadable");
  EXPECT_NE(load("v 0 0 0\nv 1 1 1\nl 1 2\n", "obj").error().message.find("no triangles"), std::string::npos);
}

/// An attachment of a recording, in memory.
scenegraph::Resources::Attachment attached(const std::string& name, std::string_view text) {
  return {.name = name, .media_type = "", .bytes = text.size(), .read = [text] {
            return scenegraph::Payload{bytesOf(text), nullptr};
          }};
}

TEST_F(MeshFormats, AttachedMeshesFindTheFilesThatAreAttachedBesideThem) {
  resources_.addAttachment(attached("package://arm/meshes/t.mtl", test::kMtl));
  resources_.addAttachment(attached("package://arm/meshes/t.obj", test::kObj));
  resources_.addAttachment(attached("package://arm/../../../../etc/evil.mtl", test::kMtl));
  const MeshLoader loader(cache_, resources_);
  const auto mesh = loader.load("package://arm/meshes/t.obj");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ((*mesh)->remarks, "");
  const auto& material = (*mesh)->materials[(*mesh)->submeshes[0].material];
  EXPECT_EQ(material.color, (std::array<float, 4>{1.0F, 0.0F, 0.2F, 0.5F}));
  for (const auto& left : std::filesystem::directory_iterator(std::filesystem::temp_directory_path())) {
    EXPECT_FALSE(left.path().filename().string().starts_with("stillframe-mesh-") && left.is_directory() &&
                 std::filesystem::exists(left.path() / "arm/meshes/t.mtl"))
        << left.path();
  }
}

TEST_F(MeshFormats, AttachedMeshesOfOneContentMayHaveDifferentFilesBesideThem) {
  resources_.addAttachment(attached("one/t.obj", test::kObj));
  resources_.addAttachment(attached("two/t.obj", test::kObj));
  resources_.addAttachment(attached("one/t.mtl", test::kMtl));
  resources_.addAttachment(attached("two/t.mtl", "newmtl red\nKd 0 1 0\n"));
  const MeshLoader loader(cache_, resources_);
  const auto one = loader.load("one/t.obj");
  const auto two = loader.load("two/t.obj");
  ASSERT_TRUE(one && two);
  EXPECT_EQ((*one)->materials[(*one)->submeshes[0].material].color[0], 1.0F);
  EXPECT_EQ((*two)->materials[(*two)->submeshes[0].material].color[1], 1.0F);
}

}  // namespace
}  // namespace stillframe::nodes
