#include "nodes/primitives/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace stillframe::nodes {
namespace {

/// One circle of a surface of revolution about z: radius and height, and its normal in the same half plane.
struct Ring {
  double radius = 0.0;
  double z = 0.0;
  double normal_radial = 0.0;
  double normal_z = 0.0;
};

/// Joins two rings by triangles, seen counter-clockwise from outside when the second lies above the first.
void addBand(TriangleMesh& mesh, const Ring& below, const Ring& above, unsigned sides) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (unsigned i = 0; i <= sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i % sides) / sides;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    for (const Ring& ring : {below, above}) {
      mesh.positions.emplace_back(ring.radius * c, ring.radius * s, ring.z);
      mesh.normals.emplace_back(
          glm::normalize(glm::dvec3(ring.normal_radial * c, ring.normal_radial * s, ring.normal_z)));
    }
  }
  for (unsigned i = 0; i < sides; ++i) {
    const std::uint32_t a = first + 2 * i;
    if (below.radius > 0.0) {
      mesh.triangles.insert(mesh.triangles.end(), {a, a + 2, a + 1});
    }
    if (above.radius > 0.0) {
      mesh.triangles.insert(mesh.triangles.end(), {a + 1, a + 2, a + 3});
    }
  }
}

void addFrustum(TriangleMesh& mesh, double bottom_radius, double top_radius, double bottom, double top,
                unsigned sides) {
  const double slope = (bottom_radius - top_radius) / (top - bottom);
  if (bottom_radius > 0.0) {
    addBand(mesh, {0.0, bottom, 0.0, -1.0}, {bottom_radius, bottom, 0.0, -1.0}, sides);
  }
  addBand(mesh, {bottom_radius, bottom, 1.0, slope}, {top_radius, top, 1.0, slope}, sides);
  if (top_radius > 0.0) {
    addBand(mesh, {top_radius, top, 0.0, 1.0}, {0.0, top, 0.0, 1.0}, sides);
  }
}

/// Half a sphere or more about (0, 0, z), between two angles from the equator.
void addCap(TriangleMesh& mesh, double radius, double z, double from, double to, unsigned rings, unsigned sides) {
  const auto ringAt = [&](unsigned i) {
    const double angle = from + (to - from) * i / rings;
    // Exactly on the axis at the poles.
    const bool is_pole = std::abs(std::abs(angle) - std::numbers::pi / 2) < 1e-9;
    const double c = is_pole ? 0.0 : std::cos(angle);
    return Ring{radius * c, z + radius * std::sin(angle), c, std::sin(angle)};
  };
  for (unsigned i = 0; i < rings; ++i) {
    addBand(mesh, ringAt(i), ringAt(i + 1), sides);
  }
}

/// Turned so that what lay along z lies along x; handedness is kept.
void turnZToX(TriangleMesh& mesh) {
  for (auto* const vectors : {&mesh.positions, &mesh.normals}) {
    for (glm::vec3& v : *vectors) {
      v = {v.z, v.x, v.y};
    }
  }
}

constexpr double kQuarter = std::numbers::pi / 2;

}  // namespace

void TriangleMesh::append(const TriangleMesh& other, const glm::vec3& scale, const glm::vec3& offset) {
  const auto first = static_cast<std::uint32_t>(positions.size());
  for (const glm::vec3& position : other.positions) {
    positions.push_back(position * scale + offset);
  }
  for (const glm::vec3& normal : other.normals) {
    normals.push_back(glm::normalize(normal / scale));
  }
  for (const std::uint32_t index : other.triangles) {
    triangles.push_back(first + index);
  }
}

TriangleMesh boxMesh() {
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      glm::vec3 normal(0.0F);
      normal[axis] = side;
      // u, v and the outward normal are right-handed.
      for (const auto& [u, v] : {std::pair{-0.5F, -0.5F}, {0.5F, -0.5F}, {0.5F, 0.5F}, {-0.5F, 0.5F}}) {
        glm::vec3 corner(0.0F);
        corner[axis] = 0.5F * side;
        corner[(axis + 1) % 3] = u * side;
        corner[(axis + 2) % 3] = v;
        mesh.positions.push_back(corner);
        mesh.normals.push_back(normal);
      }
      mesh.triangles.insert(mesh.triangles.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    }
  }
  return mesh;
}

TriangleMesh sphereMesh(unsigned sides) {
  TriangleMesh mesh;
  addCap(mesh, 0.5, 0.0, -kQuarter, kQuarter, std::max(sides / 2, 2U), sides);
  return mesh;
}

TriangleMesh frustumMesh(float bottom_radius, float top_radius, unsigned sides) {
  TriangleMesh mesh;
  addFrustum(mesh, bottom_radius, top_radius, -0.5, 0.5, sides);
  return mesh;
}

TriangleMesh arrowMesh(unsigned sides) {
  TriangleMesh mesh;
  addFrustum(mesh, 0.5, 0.5, 0.0, 0.77, sides);
  addFrustum(mesh, 1.0, 0.0, 0.77, 1.0, sides);
  turnZToX(mesh);
  return mesh;
}

TriangleMesh capsuleMesh(float radius, float length, unsigned sides) {
  TriangleMesh mesh;
  const double half = 0.5 * length;
  const unsigned rings = std::max(sides / 4, 1U);
  addCap(mesh, radius, -half, -kQuarter, 0.0, rings, sides);
  if (length > 0.0F) {
    addBand(mesh, {radius, -half, 1.0, 0.0}, {radius, half, 1.0, 0.0}, sides);
  }
  addCap(mesh, radius, half, 0.0, kQuarter, rings, sides);
  return mesh;
}

TriangleMesh discMesh(unsigned sides) {
  TriangleMesh mesh;
  addBand(mesh, {0.0, 0.0, 0.0, -1.0}, {0.5, 0.0, 0.0, -1.0}, sides);
  addBand(mesh, {0.5, 0.0, 0.0, 1.0}, {0.0, 0.0, 0.0, 1.0}, sides);
  return mesh;
}

TriangleMesh squareMesh() {
  TriangleMesh mesh;
  mesh.positions = {{-0.5F, -0.5F, 0.0F}, {0.5F, -0.5F, 0.0F}, {0.5F, 0.5F, 0.0F}, {-0.5F, 0.5F, 0.0F}};
  mesh.normals.assign(4, glm::vec3(0.0F, 0.0F, 1.0F));
  mesh.triangles = {0, 1, 2, 0, 2, 3};
  return mesh;
}

}  // namespace stillframe::nodes
