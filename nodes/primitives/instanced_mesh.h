#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <osg/Array>
#include <osg/BoundingBox>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/PrimitiveSet>
#include <osg/ref_ptr>
#include <span>
#include <string>
#include <vector>

#include "nodes/primitives/triangle_mesh.h"
#include "scenegraph/settings.h"
#include "tf/rigid_transform.h"

namespace stillframe::nodes {

/// One copy of a mesh, in the layout of the shader's texels.
struct Instance {
  std::array<float, 12> local_from_mesh{};  ///< three rows of four, relative to the origin of the InstancedMesh
  float rgb = 0.0F;                         ///< 0xrrggbb, sRGB
  float alpha = 1.0F;
  float taper = 1.0F;  ///< below 1: radius at z = +0.5; above 1: 2 - radius at z = -0.5; of a frustum's unit radius
  float id = 0.0F;     ///< the caller's, exact below 2^24; not drawn
};
static_assert(sizeof(Instance) == 64);

/// A mesh scaled along its own axes, then placed. Positions beyond 1e18 m of the origin, NaN and infinities give a copy
/// of no extent, which is not seen. Colours are clamped to 0..1; NaN is 0.
[[nodiscard]] Instance makeInstance(const tf::RigidTransform& frame_from_mesh, const glm::dvec3& scale,
                                    const glm::dvec3& origin_in_frame, const scenegraph::Color& color);

/// Any number of copies of one mesh in one draw call, for every layer that draws shapes.
///
/// node() is a MatrixTransform with the origin, in double, so that copies may lie anywhere: choose an origin near them.
/// Beneath it lies one geometry with the mesh; the copies are texels of an array-backed texture buffer, so that stock
/// OSG draws them, and an exported file keeps them. Changes go to the CPU arrays at once; commit() takes them to the
/// bound and to the GPU, at the cost of what changed. GUI thread.
class InstancedMesh {
 public:
  InstancedMesh(const TriangleMesh& mesh, const std::string& name);

  [[nodiscard]] osg::MatrixTransform& node() const noexcept { return *node_; }
  [[nodiscard]] std::size_t size() const noexcept { return texels_->size() / kTexels; }
  [[nodiscard]] const glm::dvec3& origin() const noexcept { return origin_; }

  /// Where the copies' matrices are relative to; moves them all.
  void setOrigin(const glm::dvec3& origin_in_frame);
  /// Drops copies from the end, or adds such as are not seen.
  void resize(std::size_t count);
  /// `instances` take the place of those from `first` on; all must be within size().
  void set(std::size_t first, std::span<const Instance> instances);
  /// Blended when true (scenegraph::setBlended).
  void setBlended(bool is_blended);
  /// Call once after changes, before the next frame.
  void commit();

  /// Box of all copies relative to the origin, as of the last commit(); invalid without any.
  [[nodiscard]] const osg::BoundingBoxd& box() const noexcept { return box_; }

 private:
  static constexpr std::size_t kTexels = 4;
  static constexpr std::size_t kBlock = 32;  // copies that share a box

  [[nodiscard]] const Instance& at(std::size_t index) const;
  void touch(std::size_t first, std::size_t last);
  void setCorners();

  osg::ref_ptr<osg::MatrixTransform> node_;
  osg::ref_ptr<osg::Geometry> geometry_;
  osg::ref_ptr<osg::Vec3Array> vertices_;  // of the mesh, and two corners of the bound
  osg::ref_ptr<osg::DrawElementsUInt> triangles_;
  osg::ref_ptr<osg::Vec4Array> texels_;
  glm::dvec3 origin_{0.0};
  glm::dvec3 mesh_low_{0.0};
  glm::dvec3 mesh_high_{0.0};
  std::vector<osg::BoundingBoxd> boxes_;  // one a block
  std::vector<std::uint8_t> is_block_touched_;
  std::vector<std::size_t> touched_blocks_;
  bool is_dirty_ = false;
  osg::BoundingBoxd box_;
};

}  // namespace stillframe::nodes
