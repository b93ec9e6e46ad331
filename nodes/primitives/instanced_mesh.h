#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <osg/Array>
#include <osg/BoundingBox>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/PrimitiveSet>
#include <osg/Uniform>
#include <osg/ref_ptr>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "nodes/primitives/instance.h"
#include "nodes/primitives/triangle_mesh.h"
#include "scenegraph/layer.h"
#include "scenegraph/pick/pick_hit.h"

namespace stillframe::nodes {

/// Any number of copies of one mesh in one draw call, for every layer that draws shapes.
///
/// node() is a MatrixTransform with the origin, in double, so that copies may lie anywhere: choose an origin near them.
/// Beneath it lies one geometry with the mesh; the copies are texels of an array-backed texture buffer, so that stock
/// OSG draws them, and an exported file keeps them. Changes go to the CPU arrays at once; commit() takes them to the
/// bound and to the GPU, at the cost of what changed. GUI thread.
class InstancedMesh {
 public:
  /// What a mesh is drawn as.
  enum class Look : std::uint8_t {
    Solid,   ///< lit from the eye
    Square,  ///< turned to the viewer about its origin, unlit; matrices scale and place it, and turn nothing
  };

  InstancedMesh(const TriangleMesh& mesh, const std::string& name, Look look = Look::Solid);

  [[nodiscard]] osg::MatrixTransform& node() const noexcept { return *node_; }
  [[nodiscard]] std::size_t size() const noexcept { return texels_->size() / kTexels; }
  [[nodiscard]] const glm::dvec3& origin() const noexcept { return origin_; }

  /// Where the copies' matrices are relative to; moves them all.
  void setOrigin(const glm::dvec3& origin_in_frame);
  /// Drops copies from the end, or adds such as are not seen.
  void resize(std::size_t count);
  /// `instances` take the place of those from `first` on; all must be within size().
  void set(std::size_t first, std::span<const Instance> instances);
  /// Those from `first` on are not seen any more; what lies beyond size() does not count.
  void hide(std::size_t first, std::size_t count);
  /// Blended when true (scenegraph::setBlended).
  void setBlended(bool is_blended);
  /// Multiplies every copy's alpha; counts when blended.
  void setOpacity(double opacity);
  /// What the driver takes in one texture buffer; copies that need more are not drawn, and have no box.
  void setBufferTexels(std::uint64_t texels);
  /// What size() copies need, where that is more than the driver takes; else 0.
  [[nodiscard]] std::uint64_t texelsTooMany() const noexcept {
    return texels_->size() > buffer_texels_ ? texels_->size() : 0;
  }
  /// Call once after changes, before the next frame.
  void commit();

  /// A copy as it was set; index < size().
  [[nodiscard]] const Instance& at(std::size_t index) const;
  /// Where the surface of a copy is hit, in the frame of the node's parent: by ray and triangle in double. Of a square
  /// that faces the viewer its middle.
  [[nodiscard]] glm::dvec3 surfacePoint(const scenegraph::PickHit& hit) const;

  /// Box of all copies relative to the origin, as of the last commit(); invalid without any.
  [[nodiscard]] const osg::BoundingBoxd& box() const noexcept { return box_; }

 private:
  static constexpr std::size_t kTexels = 4;
  static constexpr std::size_t kBlock = 32;  // copies that share a box

  void touch(std::size_t first, std::size_t last);
  void upload();
  void setCorners();

  osg::ref_ptr<osg::MatrixTransform> node_;
  osg::ref_ptr<osg::Geometry> geometry_;
  osg::ref_ptr<osg::Vec3Array> vertices_;  // of the mesh, and two corners of the bound
  osg::ref_ptr<osg::DrawElementsUInt> triangles_;
  osg::ref_ptr<osg::Vec4Array> texels_;
  osg::ref_ptr<osg::Uniform> opacity_;
  glm::dvec3 origin_{0.0};
  glm::dvec3 mesh_low_{0.0};
  glm::dvec3 mesh_high_{0.0};
  std::vector<osg::BoundingBoxd> boxes_;  // one a block
  std::vector<std::uint8_t> is_block_touched_;
  std::vector<std::size_t> touched_blocks_;
  std::vector<std::pair<std::size_t, std::size_t>> touched_;  // copies, as they were written
  bool is_resized_ = false;
  bool faces_viewer_ = false;
  bool is_dirty_ = false;
  std::uint64_t buffer_texels_ = scenegraph::kUsualBufferTexels;
  osg::BoundingBoxd box_;
};

}  // namespace stillframe::nodes
