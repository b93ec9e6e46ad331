#include "scenegraph/pick/pick_hit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace stillframe::scenegraph {
namespace {

std::array<std::uint32_t, 3> cornersOfStrip(std::uint32_t primitive) {
  // Every other triangle of a strip runs the other way round.
  return primitive % 2 == 0 ? std::array{primitive, primitive + 1, primitive + 2}
                            : std::array{primitive + 1, primitive, primitive + 2};
}

}  // namespace

bool PickHit::isBeneath(const osg::Node& node) const { return std::ranges::find(path, &node) != path.end(); }

const osg::Node* PickHit::childOf(const osg::Node& ancestor) const {
  const auto found = std::ranges::find(path, &ancestor);
  return found == path.end() || found + 1 == path.end() ? nullptr : *(found + 1);
}

std::optional<glm::dvec3> meetPlane(const PickRay& ray, const std::array<glm::dvec3, 3>& corners) {
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double along = glm::dot(ray.direction, normal);
  const double t = glm::dot(corners[0] - ray.origin, normal) / along;
  const glm::dvec3 at = ray.origin + t * ray.direction;
  const bool is_finite = std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z);
  // Seen from the edge, a plane is met anywhere.
  constexpr double kSmallestSine = 1e-6;
  const bool is_crossed = std::abs(along) > kSmallestSine * glm::length(normal) * glm::length(ray.direction);
  return is_finite && is_crossed ? std::optional(at) : std::nullopt;
}

std::optional<std::array<std::uint32_t, 3>> triangleOf(const osg::Geometry& geometry, std::uint32_t primitive) {
  if (geometry.getNumPrimitiveSets() != 1) {
    return std::nullopt;
  }
  const osg::PrimitiveSet& set = *geometry.getPrimitiveSet(0);
  std::array<std::uint32_t, 3> corners{};
  if (set.getMode() == GL_TRIANGLES) {
    corners = {3 * primitive, 3 * primitive + 1, 3 * primitive + 2};
  } else if (set.getMode() == GL_TRIANGLE_STRIP) {
    corners = cornersOfStrip(primitive);
  } else {
    return std::nullopt;
  }
  for (std::uint32_t& corner : corners) {
    if (corner >= set.getNumIndices()) {
      return std::nullopt;
    }
    corner = set.index(corner);
  }
  return corners;
}

glm::dvec3 surfacePoint(const PickHit& hit) {
  const auto* const geometry = dynamic_cast<const osg::Geometry*>(&hit.drawable());
  const auto* const vertices =
      geometry == nullptr ? nullptr : dynamic_cast<const osg::Vec3Array*>(geometry->getVertexArray());
  const auto triangle = vertices == nullptr ? std::nullopt : triangleOf(*geometry, hit.primitive);
  if (!triangle || std::ranges::any_of(*triangle, [&](std::uint32_t i) { return i >= vertices->size(); })) {
    return hit.point_in_frame;
  }
  std::array<glm::dvec3, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const osg::Vec3d at = osg::Vec3d((*vertices)[(*triangle)[i]]) * hit.frame_from_local;
    corners[i] = {at.x(), at.y(), at.z()};
  }
  return meetPlane(hit.ray_in_frame, corners).value_or(hit.point_in_frame);
}

}  // namespace stillframe::scenegraph
