#include "nodes/primitives/triangle_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <ostream>
#include <string>

namespace stillframe::nodes {
namespace {

struct ShapeCase {
  const char* name;
  TriangleMesh mesh;
  glm::vec3 low;
  glm::vec3 high;
  double volume;
};

std::ostream& operator<<(std::ostream& out, const ShapeCase& shape) { return out << shape.name; }

class ClosedShape : public testing::TestWithParam<ShapeCase> {};

glm::dvec3 corner(const TriangleMesh& mesh, std::size_t i) { return glm::dvec3(mesh.positions[mesh.triangles[i]]); }

TEST_P(ClosedShape, IsClosedAndWoundOutward) {
  const TriangleMesh& mesh = GetParam().mesh;
  const auto key = [](const glm::dvec3& p) {
    return std::array{std::lround(1e5 * p.x), std::lround(1e5 * p.y), std::lround(1e5 * p.z)};
  };
  std::map<std::pair<std::array<long, 3>, std::array<long, 3>>, int> edges;
  double volume = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const std::array points{corner(mesh, i), corner(mesh, i + 1), corner(mesh, i + 2)};
    volume += glm::dot(points[0], glm::cross(points[1], points[2])) / 6.0;
    for (std::size_t e = 0; e < 3; ++e) {
      const auto from = key(points[e]);
      const auto to = key(points[(e + 1) % 3]);
      ASSERT_NE(from, to) << "a triangle without area";
      from < to ? ++edges[{from, to}] : --edges[{to, from}];
    }
  }
  for (const auto& [edge, balance] : edges) {
    ASSERT_EQ(balance, 0) << "an edge that is not met from the other side";
  }
  EXPECT_NEAR(volume, GetParam().volume, 0.03 * GetParam().volume);
}

TEST_P(ClosedShape, HasUnitNormalsOnTheSideOfItsTriangles) {
  const TriangleMesh& mesh = GetParam().mesh;
  ASSERT_EQ(mesh.positions.size(), mesh.normals.size());
  for (const glm::vec3& normal : mesh.normals) {
    ASSERT_NEAR(glm::length(normal), 1.0, 1e-5);
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const glm::dvec3 a = corner(mesh, i);
    const glm::dvec3 face = glm::normalize(glm::cross(corner(mesh, i + 1) - a, corner(mesh, i + 2) - a));
    for (std::size_t v = 0; v < 3; ++v) {
      ASSERT_GT(glm::dot(face, glm::dvec3(mesh.normals[mesh.triangles[i + v]])), 0.9);
    }
  }
}

TEST_P(ClosedShape, ReachesItsBox) {
  glm::vec3 low(1e9F);
  glm::vec3 high(-1e9F);
  for (const glm::vec3& position : GetParam().mesh.positions) {
    low = glm::min(low, position);
    high = glm::max(high, position);
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(low[axis], GetParam().low[axis], 1e-6) << axis;
    EXPECT_NEAR(high[axis], GetParam().high[axis], 1e-6) << axis;
  }
}

constexpr double kPi = std::numbers::pi;
constexpr glm::vec3 kHalf(0.5F);

INSTANTIATE_TEST_SUITE_P(
    Shapes, ClosedShape,
    testing::Values(ShapeCase{"box", boxMesh(), -kHalf, kHalf, 1.0},
                    ShapeCase{"sphere", sphereMesh(32), -kHalf, kHalf, kPi / 6},
                    ShapeCase{"cylinder", frustumMesh(0.5F, 0.5F, 32), -kHalf, kHalf, kPi / 4},
                    ShapeCase{"cone", frustumMesh(0.5F, 0.0F, 32), -kHalf, kHalf, kPi / 12},
                    ShapeCase{"frustum", frustumMesh(0.25F, 0.5F, 32), -kHalf, kHalf, kPi / 12 * 1.75},
                    ShapeCase{"arrow", arrowMesh(32), {0, -1, -1}, {1, 1, 1}, kPi * (0.25 * 0.77 + 0.23 / 3)},
                    ShapeCase{"capsule",
                              capsuleMesh(0.2F, 1.0F, 32),
                              {-0.2F, -0.2F, -0.7F},
                              {0.2F, 0.2F, 0.7F},
                              kPi * 0.04 * (1.0 + 4.0 / 3 * 0.2)}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST(TriangleMesh, AppendsAScaledAndMovedShapeWithRightNormals) {
  TriangleMesh mesh = boxMesh();
  mesh.append(frustumMesh(0.5F, 0.0F), {2, 2, 0.1F}, {0, 0, 3});
  EXPECT_EQ(mesh.positions.size(), mesh.normals.size());
  const glm::vec3 side = mesh.normals[boxMesh().positions.size() + frustumMesh(0.5F, 0.0F).positions.size() - 1];
  EXPECT_NEAR(glm::length(side), 1.0, 1e-6);
  EXPECT_GT(side.z, 0.99) << "the cone has become flat";
  EXPECT_EQ(mesh.triangles.back(), frustumMesh(0.5F, 0.0F).triangles.back() + 24);
}

TEST(DiscMesh, FacesBothWays) {
  const TriangleMesh disc = discMesh();
  int up = 0;
  for (const glm::vec3& normal : disc.normals) {
    EXPECT_EQ(std::abs(normal.z), 1.0F);
    up += normal.z > 0.0F ? 1 : -1;
  }
  EXPECT_EQ(up, 0);
}

}  // namespace
}  // namespace stillframe::nodes
