#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace stillframe::nodes {

/// A shape as indexed triangles, counter-clockwise from outside, with a unit normal for each vertex.
struct TriangleMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;        ///< one a position
  std::vector<std::uint32_t> triangles;  ///< three a triangle

  /// Adds another after its points were scaled by `scale` and moved by `offset`. `scale` must be positive.
  void append(const TriangleMesh& other, const glm::vec3& scale, const glm::vec3& offset);
};

/// Unit shapes: the sources of instances and of robots' geometry. Each call makes one anew.
/// @{
/// Edges of 1 about the origin.
[[nodiscard]] TriangleMesh boxMesh();
/// Diameter 1 about the origin.
[[nodiscard]] TriangleMesh sphereMesh(unsigned sides = 24);
/// Along z from -0.5 to 0.5 with these radii and caps where they are not 0: a cylinder of diameter 1, a cone.
[[nodiscard]] TriangleMesh frustumMesh(float bottom_radius = 0.5F, float top_radius = 0.5F, unsigned sides = 24);
/// From the origin to (1, 0, 0), in the proportions that RViz gives a marker arrow with a pose: the shaft 0.77 long
/// and 1 in diameter, the head 0.23 long and 2 in diameter.
[[nodiscard]] TriangleMesh arrowMesh(unsigned sides = 24);
/// Along z about the origin: a cylinder of this radius and length with half a sphere at either end.
[[nodiscard]] TriangleMesh capsuleMesh(float radius, float length, unsigned sides = 24);
/// In the plane z = 0, diameter 1 about the origin, with a face to either side.
[[nodiscard]] TriangleMesh discMesh(unsigned sides = 24);
/// In the plane z = 0, edges of 1 about the origin, facing +z only.
[[nodiscard]] TriangleMesh squareMesh();
/// @}

}  // namespace stillframe::nodes
