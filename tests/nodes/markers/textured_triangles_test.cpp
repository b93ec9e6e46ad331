#include "nodes/markers/textured_triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "tools/sample/image_writers.h"

namespace stillframe::nodes {
namespace {

using scenegraph::Payload;
using scenegraph::TrianglePrimitive;

Payload payloadOf(std::vector<std::byte> bytes) {
  const auto held = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
  return {*held, held};
}

/// Two triangles that lie flat, with a red picture of one row.
TrianglePrimitive square() {
  TrianglePrimitive triangles;
  triangles.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  triangles.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 1}, {1, 0}, {0, 0}};
  triangles.texture_url = "embedded://red";
  triangles.texture = payloadOf(sample::writeRgbPng(2, {255, 0, 0, 255, 0, 0}));
  return triangles;
}

class TexturedTrianglesTest : public ::testing::Test {
 protected:
  scenegraph::ObjectCache cache_{std::size_t{1} << 20U};
  scenegraph::Resources resources_;
  MeshLoader loader_{cache_, resources_};
};

TEST_F(TexturedTrianglesTest, TakesPointsCoordinatesAndThePicture) {
  const TexturedTriangles made = texturedTriangles(square(), loader_);
  EXPECT_FALSE(made.failure);
  EXPECT_EQ(made.mesh.positions.size(), 6U);
  EXPECT_EQ(made.mesh.uvs.size(), 6U);
  ASSERT_EQ(made.mesh.textures.size(), 1U);
  EXPECT_EQ(made.mesh.textures[0].width, 2U);
  EXPECT_EQ(made.mesh.textures[0].rgba[0], 255);
  EXPECT_EQ(made.mesh.normals[0], glm::vec3(0, 0, 1)) << "lit, having no colours of its own";
}

TEST_F(TexturedTrianglesTest, IsRelativeToItsFirstPointWhereverThatIs) {
  TrianglePrimitive far = square();
  for (glm::dvec3& point : far.points) {
    point += glm::dvec3(5e6, -4e6, 100.0);
  }
  const TexturedTriangles made = texturedTriangles(far, loader_);
  EXPECT_EQ(made.origin, glm::dvec3(5e6, -4e6, 100.0));
  EXPECT_EQ(made.mesh.positions[1], glm::vec3(1, 0, 0));
}

TEST_F(TexturedTrianglesTest, LeavesOutTrianglesThatAreNowhereAndBoundsCoordinatesThatAreNoNumbers) {
  TrianglePrimitive bad = square();
  bad.points[1].x = std::numeric_limits<double>::quiet_NaN();
  bad.uvs[3].x = std::numeric_limits<float>::infinity();
  const TexturedTriangles made = texturedTriangles(bad, loader_);
  ASSERT_EQ(made.mesh.positions.size(), 3U);
  EXPECT_EQ(made.mesh.uvs[0], glm::vec2(0.0F));
  bad.points.assign(6, glm::dvec3(1e300));
  EXPECT_TRUE(texturedTriangles(bad, loader_).mesh.positions.empty());
}

TEST_F(TexturedTrianglesTest, SaysThatNoneOfThemCanBeSeen) {
  TrianglePrimitive flat = square();
  flat.points.assign(6, glm::dvec3(1, 2, 3));
  const auto failure = texturedTriangles(flat, loader_).failure;
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->code, "MeshIncomplete");
  EXPECT_NE(failure->message.find("none of its 2 triangles"), std::string::npos) << failure->message;
}

TEST_F(TexturedTrianglesTest, ListsOfUnequalLengthsAreReadAsFarAsBothGo) {
  TrianglePrimitive odd = square();
  odd.uvs.resize(5);
  odd.colors.resize(2);
  EXPECT_EQ(texturedTriangles(odd, loader_).mesh.positions.size(), 3U);
  odd.uvs.clear();
  EXPECT_TRUE(texturedTriangles(odd, loader_).mesh.positions.empty());
}

TEST_F(TexturedTrianglesTest, PicturesCutOffOrChangedAnywhereAreAStatusOrAPicture) {
  const auto picture = sample::writeRgbPng(2, {255, 0, 0, 255, 0, 0});
  std::mt19937 random(3);
  TrianglePrimitive triangles = square();
  for (std::size_t cut = 0; cut < picture.size(); ++cut) {
    triangles.texture = payloadOf({picture.begin(), picture.begin() + static_cast<std::ptrdiff_t>(cut)});
    const TexturedTriangles made = texturedTriangles(triangles, loader_);
    EXPECT_NE(made.failure.has_value(), !made.mesh.textures.empty()) << cut << " bytes";
    auto changed = picture;
    changed[random() % changed.size()] ^= static_cast<std::byte>(1U << random() % 8U);
    triangles.texture = payloadOf(std::move(changed));
    const TexturedTriangles other = texturedTriangles(triangles, loader_);
    EXPECT_NE(other.failure.has_value(), !other.mesh.textures.empty());
    EXPECT_EQ(other.mesh.positions.size(), 6U) << "the triangles are there either way";
  }
}

}  // namespace
}  // namespace stillframe::nodes
