#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <osg/Array>
#include <osg/BoundingBox>
#include <osg/Geometry>
#include <osg/Referenced>
#include <osg/ref_ptr>
#include <span>
#include <utility>
#include <vector>

namespace stillframe::scenegraph {

/// The boxes of the runs of a list of triangles, in the space of their vertices, so that a pick draws only those near
/// the cursor. They hang on the primitive set as user data that no file keeps. 24 bytes for 6 KiB of indices.
class TriangleBoxes : public osg::Referenced {
 public:
  static constexpr std::size_t kTriangles = 512;  ///< of a run

  explicit TriangleBoxes(std::vector<osg::BoundingBox> found) : boxes_(std::move(found)) {}
  [[nodiscard]] std::span<const osg::BoundingBox> boxes() const noexcept { return boxes_; }

 private:
  std::vector<osg::BoundingBox> boxes_;
};

/// Finds them, where there are several, and returns the box of all. Each index lies within `positions`. Any thread that
/// has both to itself.
inline osg::BoundingBox findTriangleBoxes(osg::DrawElementsUInt& triangles, const osg::Vec3Array& positions) {
  constexpr std::size_t kIndices = 3 * TriangleBoxes::kTriangles;
  const auto& indices = triangles.asVector();
  osg::BoundingBox all;
  std::vector<osg::BoundingBox> boxes;
  for (std::size_t first = 0; first < indices.size(); first += kIndices) {
    osg::BoundingBox box;
    for (const unsigned index : std::span(indices).subspan(first, std::min(kIndices, indices.size() - first))) {
      box.expandBy(positions[index]);
    }
    boxes.push_back(box);
    all.expandBy(box);
  }
  if (boxes.size() > 1) {
    triangles.setUserData(new TriangleBoxes(std::move(boxes)));
  }
  return all;
}

/// The triangles of a drawable and their boxes; nullptr and none where they were not found, or the triangles have
/// become more or fewer since.
[[nodiscard]] inline std::pair<const osg::DrawElementsUInt*, std::span<const osg::BoundingBox>> triangleBoxesOf(
    const osg::Drawable& drawable) {
  const osg::Geometry* const geometry = drawable.asGeometry();
  const auto* const triangles = geometry == nullptr || geometry->getNumPrimitiveSets() != 1
                                    ? nullptr
                                    : dynamic_cast<const osg::DrawElementsUInt*>(geometry->getPrimitiveSet(0));
  const auto* const known =
      triangles == nullptr ? nullptr : dynamic_cast<const TriangleBoxes*>(triangles->getUserData());
  constexpr std::size_t kIndices = 3 * TriangleBoxes::kTriangles;
  if (known == nullptr || known->boxes().size() != (triangles->size() + kIndices - 1) / kIndices) {
    return {};
  }
  return {triangles, known->boxes()};
}

/// As long as it lives a geometry draws some runs of its triangles, one after the other. Thread of the context only.
class SomeTriangles {
 public:
  SomeTriangles(osg::Geometry& geometry, const osg::DrawElementsUInt& all, std::span<const std::uint32_t> runs)
      : geometry_(&geometry), whole_(geometry.getPrimitiveSetList()) {
    constexpr std::size_t kIndices = 3 * TriangleBoxes::kTriangles;
    const std::span<const GLuint> indices = all.asVector();
    const osg::ref_ptr<osg::DrawElementsUInt> some = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (const std::uint32_t run : runs) {
      const std::size_t first = run * kIndices;
      const auto of_run = indices.subspan(first, std::min(kIndices, indices.size() - first));
      some->insert(some->end(), of_run.begin(), of_run.end());
    }
    geometry_->getPrimitiveSetList() = {some};
  }
  ~SomeTriangles() { geometry_->getPrimitiveSetList() = whole_; }
  SomeTriangles(const SomeTriangles&) = delete;
  SomeTriangles& operator=(const SomeTriangles&) = delete;

 private:
  osg::ref_ptr<osg::Geometry> geometry_;
  osg::Geometry::PrimitiveSetList whole_;
};

}  // namespace stillframe::scenegraph
