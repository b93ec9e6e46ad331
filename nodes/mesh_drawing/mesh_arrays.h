#pragma once

#include <cstddef>
#include <osg/Array>
#include <osg/BoundingBox>
#include <osg/Group>
#include <osg/PrimitiveSet>
#include <osg/StateSet>
#include <osg/Texture2D>
#include <osg/Uniform>
#include <osg/ref_ptr>
#include <span>
#include <vector>

#include "nodes/meshes/mesh_data.h"
#include "nodes/primitives/triangle_mesh.h"
#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// Of boxes that stand for meshes that are missing or broken.
inline constexpr scenegraph::Color kPlaceholderColor{.r = 0.95F, .g = 0.3F, .b = 0.75F, .a = 0.45F};

/// A mesh in the form that is uploaded: what robots and mesh markers hang into the graph.
///
/// Made on a worker, shared by any number of nodes and views: their geometries refer to one set of buffers. Immutable
/// but for releaseGlObjects(), which is the GUI thread's.
class MeshArrays {
 public:
  explicit MeshArrays(const MeshData& mesh);
  explicit MeshArrays(const TriangleMesh& mesh);

  /// A group with a geometry for each material. Colours are the mesh's own where it has any (RViz's rule), else
  /// `color`; with `is_overriding` they are all `color`. The alpha of `color` multiplies that of the mesh.
  [[nodiscard]] osg::ref_ptr<osg::Group> makeNode(const scenegraph::Color& color, bool is_overriding = false) const;

  [[nodiscard]] const osg::BoundingBoxd& box() const noexcept { return box_; }
  [[nodiscard]] std::size_t triangleCount() const noexcept { return triangles_; }
  [[nodiscard]] std::size_t byteSize() const noexcept { return bytes_; }
  void releaseGlObjects() const;

 private:
  struct Part {
    osg::ref_ptr<osg::DrawElementsUInt> triangles;
    osg::BoundingBox box;                  // of their vertices
    osg::ref_ptr<osg::Texture2D> texture;  // or nullptr
    scenegraph::Color color;
    bool has_own_color = false;
  };
  void setVertices(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals);

  osg::ref_ptr<osg::Vec3Array> positions_;
  osg::ref_ptr<osg::Vec3Array> normals_;
  osg::ref_ptr<osg::Vec2Array> uvs_;       // or nullptr
  osg::ref_ptr<osg::Vec4ubArray> colors_;  // one a vertex, or nullptr
  osg::ref_ptr<osg::Vec4ubArray> white_;
  bool has_translucent_colors_ = false;
  std::vector<Part> parts_;
  osg::BoundingBoxd box_;
  std::size_t triangles_ = 0;
  std::size_t bytes_ = 0;
};

/// State that nodes of meshes are drawn with, to be put above them: the program, and an opacity over all of it. GUI
/// thread.
class MeshState {
 public:
  MeshState();
  [[nodiscard]] osg::StateSet* stateSet() const noexcept { return state_.get(); }
  void setOpacity(double opacity);

 private:
  osg::ref_ptr<osg::StateSet> state_;
  osg::ref_ptr<osg::Uniform> opacity_;
};

}  // namespace stillframe::nodes
