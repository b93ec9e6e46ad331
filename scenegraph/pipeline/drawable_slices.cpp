#include "scenegraph/pipeline/drawable_slices.h"

#include <algorithm>

namespace stillframe::scenegraph {
namespace {

constexpr std::size_t kPrimitivesASlice = 1U << 15U;

/// Vertices of a primitive, where each has its own.
std::optional<std::size_t> verticesOf(GLenum mode) {
  switch (mode) {
    case GL_POINTS:
      return 1;
    case GL_LINES:
      return 2;
    case GL_TRIANGLES:
      return 3;
    default:
      return std::nullopt;
  }
}

/// Slices of a set; none where it cannot be cut.
std::optional<std::size_t> slicesOf(const osg::PrimitiveSet& set) {
  const auto vertices = verticesOf(set.getMode());
  const bool is_known = dynamic_cast<const osg::DrawArrays*>(&set) != nullptr ||
                        dynamic_cast<const osg::DrawElementsUInt*>(&set) != nullptr;
  if (!vertices || !is_known || set.getNumInstances() > 0) {
    return std::nullopt;
  }
  const std::size_t step = *vertices * kPrimitivesASlice;
  return std::max<std::size_t>(1, (set.getNumIndices() + step - 1) / step);
}

osg::ref_ptr<osg::PrimitiveSet> cut(const osg::PrimitiveSet& set, std::size_t slice) {
  const std::size_t step = verticesOf(set.getMode()).value_or(1) * kPrimitivesASlice;
  const std::size_t first = std::min<std::size_t>(slice * step, set.getNumIndices());
  const std::size_t count = std::min<std::size_t>(step, set.getNumIndices() - first);
  if (const auto* const indices = dynamic_cast<const osg::DrawElementsUInt*>(&set)) {
    const auto begin = indices->begin() + static_cast<std::ptrdiff_t>(first);
    return new osg::DrawElementsUInt(set.getMode(), begin, begin + static_cast<std::ptrdiff_t>(count));
  }
  const auto& arrays = dynamic_cast<const osg::DrawArrays&>(set);
  return new osg::DrawArrays(set.getMode(), arrays.getFirst() + static_cast<GLint>(first), static_cast<GLsizei>(count));
}

}  // namespace

std::size_t sliceCount(const osg::Drawable& drawable) {
  const osg::Geometry* const geometry = drawable.asGeometry();
  if (geometry == nullptr || !geometry->getUseVertexBufferObjects() || geometry->getDrawCallback() != nullptr ||
      geometry->getNumPrimitiveSets() != 1) {
    return 1;
  }
  return slicesOf(*geometry->getPrimitiveSet(0)).value_or(1);
}

DrawableSlice::DrawableSlice(osg::Drawable& drawable, std::optional<std::size_t> slice) {
  if (slice && sliceCount(drawable) > 1) {
    geometry_ = drawable.asGeometry();
    osg::Geometry::PrimitiveSetList& sets = geometry_->getPrimitiveSetList();
    whole_ = sets;
    sets = {cut(*whole_.front(), *slice)};
  }
}

DrawableSlice::~DrawableSlice() {
  if (geometry_ != nullptr) {
    geometry_->getPrimitiveSetList() = whole_;
  }
}

}  // namespace stillframe::scenegraph
