// Where copies of a mesh are hit, by the arithmetic of primitive.vert in double.
#include <algorithm>

#include "nodes/primitives/instanced_mesh.h"

namespace stillframe::nodes {
namespace {

glm::dvec3 localFromMesh(const Instance& copy, const glm::dvec3& vertex) {
  const double taper = static_cast<double>(copy.taper);
  const double bottom = std::min(2.0 - taper, 1.0);
  const double top = std::min(taper, 1.0);
  const double along = vertex.z + 0.5;
  const double width = bottom * (1.0 - along) + top * along;
  const glm::dvec3 shaped(vertex.x * width, vertex.y * width, vertex.z);
  glm::dvec3 local;
  for (std::size_t row = 0; row < 3; ++row) {
    const auto at = [&](std::size_t column) { return static_cast<double>(copy.local_from_mesh[4 * row + column]); };
    local[static_cast<int>(row)] = at(0) * shaped.x + at(1) * shaped.y + at(2) * shaped.z + at(3);
  }
  return local;
}

}  // namespace

glm::dvec3 InstancedMesh::surfacePoint(const scenegraph::PickHit& hit) const {
  const std::size_t first = std::size_t{3} * hit.primitive;
  if (hit.instance >= size() || first + 2 >= triangles_->size()) {
    return hit.point_in_frame;
  }
  const Instance& copy = at(hit.instance);
  const auto frameFromLocal = [&](const glm::dvec3& local) {
    const osg::Vec3d in_frame = osg::Vec3d(local.x, local.y, local.z) * hit.frame_from_local;
    return glm::dvec3(in_frame.x(), in_frame.y(), in_frame.z());
  };
  if (faces_viewer_) {
    return frameFromLocal(localFromMesh(copy, glm::dvec3(0.0)));
  }
  std::array<glm::dvec3, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const osg::Vec3& vertex = (*vertices_)[(*triangles_)[static_cast<unsigned>(first + i)]];
    corners[i] = frameFromLocal(localFromMesh(
        copy, {static_cast<double>(vertex.x()), static_cast<double>(vertex.y()), static_cast<double>(vertex.z())}));
  }
  return scenegraph::meetPlane(hit.ray_in_frame, corners).value_or(hit.point_in_frame);
}

}  // namespace stillframe::nodes
