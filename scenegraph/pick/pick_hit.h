#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <osg/Geometry>
#include <osg/Matrixd>
#include <osg/Node>
#include <string>

namespace stillframe::scenegraph {

/// A line of sight. The direction need not be of length 1.
struct PickRay {
  glm::dvec3 origin{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};
};

/// What is drawn at a pixel, as the id pass found it: a place in the graph, and which part of the drawable it is.
///
/// The path is only good until the graph changes: use a hit at once, on the thread that owns the graph.
struct PickHit {
  osg::NodePath path;              ///< from the scene's root to the drawable
  std::string frame;               ///< whose node it hangs beneath
  osg::Matrixd frame_from_local;   ///< of the drawable's own coordinates
  std::uint32_t instance = 0;      ///< gl_InstanceID
  std::uint32_t primitive = 0;     ///< gl_PrimitiveID, within the instance
  std::uint32_t vertex = 0;        ///< gl_VertexID of the provoking vertex; of a point, its own
  double off_px = 0.0;             ///< from the pixel that was asked for to the one where this is drawn
  PickRay ray_in_frame;            ///< through the middle of the pixel where it is drawn
  glm::dvec3 point_in_frame{0.0};  ///< on that ray by the depth buffer: some 1e-7 of the distance off

  [[nodiscard]] const osg::Node& drawable() const { return *path.back(); }
  /// Whether what was hit hangs beneath `node`.
  [[nodiscard]] bool isBeneath(const osg::Node& node) const;
  /// The node right beneath `ancestor` on the way to the drawable; nullptr when there is none.
  [[nodiscard]] const osg::Node* childOf(const osg::Node& ancestor) const;
};

/// Where a ray meets the plane of a triangle, in double; nullopt when it runs along it, or what comes out is not
/// finite.
[[nodiscard]] std::optional<glm::dvec3> meetPlane(const PickRay& ray, const std::array<glm::dvec3, 3>& corners);

/// The vertices of triangle `primitive` of a geometry with one primitive set; nullopt where there is no such triangle.
[[nodiscard]] std::optional<std::array<std::uint32_t, 3>> triangleOf(const osg::Geometry& geometry,
                                                                     std::uint32_t primitive);

/// The point of the surface that is hit, in the frame: by the ray and the triangle's corners in double, where the
/// drawable is a geometry whose triangles are drawn as they are, else by the depth buffer.
[[nodiscard]] glm::dvec3 surfacePoint(const PickHit& hit);

}  // namespace stillframe::scenegraph
