#include "scenegraph/pipeline/drawable_slices.h"

#include <algorithm>
#include <osg/Program>
#include <osg/State>
#include <osg/Uniform>
#include <string>

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

/// Instances that a slice has, of a set with so many vertices each.
std::size_t instancesASlice(const osg::PrimitiveSet& set) {
  const std::size_t primitives = set.getNumIndices() / verticesOf(set.getMode()).value_or(1);
  return kPrimitivesASlice / std::clamp<std::size_t>(primitives, 1, kPrimitivesASlice);
}

bool isInstanced(const osg::PrimitiveSet& set) { return set.getNumInstances() > 1; }

std::size_t slicesOf(const osg::PrimitiveSet& set) {
  if (isInstanced(set)) {
    const std::size_t step = instancesASlice(set);
    return (static_cast<std::size_t>(set.getNumInstances()) + step - 1) / step;
  }
  const auto vertices = verticesOf(set.getMode());
  const bool is_known = dynamic_cast<const osg::DrawArrays*>(&set) != nullptr ||
                        dynamic_cast<const osg::DrawElementsUInt*>(&set) != nullptr;
  if (!vertices || !is_known) {
    return 1;
  }
  const std::size_t step = *vertices * kPrimitivesASlice;
  return std::max<std::size_t>(1, (set.getNumIndices() + step - 1) / step);
}

osg::ref_ptr<osg::PrimitiveSet> cut(const osg::PrimitiveSet& set, std::size_t slice) {
  const std::size_t step = verticesOf(set.getMode()).value_or(1) * kPrimitivesASlice;
  const std::size_t first = std::min<std::size_t>(slice * step, set.getNumIndices());
  const std::size_t count = std::min<std::size_t>(step, set.getNumIndices() - first);
  if (const auto* const indices = dynamic_cast<const osg::DrawElementsUInt*>(&set)) {
    return new osg::DrawElementsUInt(set.getMode(), static_cast<unsigned>(count), indices->asVector().data() + first,
                                     set.getNumInstances());
  }
  const auto& arrays = dynamic_cast<const osg::DrawArrays&>(set);
  return new osg::DrawArrays(set.getMode(), arrays.getFirst() + static_cast<GLint>(first), static_cast<GLsizei>(count),
                             set.getNumInstances());
}

/// Draws some of the instances of a drawable's only set; nothing is copied.
class SomeInstances : public osg::Drawable::DrawCallback {
 public:
  SomeInstances(osg::PrimitiveSet& set, std::size_t slice)
      : set_(&set),
        first_(static_cast<int>(slice * instancesASlice(set))),
        count_(std::min(static_cast<int>(instancesASlice(set)), set.getNumInstances() - first_)) {}

  void drawImplementation(osg::RenderInfo& render_info, const osg::Drawable* drawable) const override {
    const osg::Program::PerContextProgram* const program = render_info.getState()->getLastAppliedProgramObject();
    if (program == nullptr || program->getUniformLocation(std::string(kFirstInstance)) < 0) {
      if (first_ == 0) {
        drawable->drawImplementation(render_info);
      }
      return;
    }
    const int all = set_->getNumInstances();
    set_->setNumInstances(count_);
    program->apply(*osg::ref_ptr<osg::Uniform>(new osg::Uniform(kFirstInstance, first_)));
    drawable->drawImplementation(render_info);
    program->apply(*osg::ref_ptr<osg::Uniform>(new osg::Uniform(kFirstInstance, 0)));
    set_->setNumInstances(all);
  }

 private:
  static constexpr const char* kFirstInstance = "u_first_instance";
  osg::ref_ptr<osg::PrimitiveSet> set_;
  int first_;
  int count_;
};

class NoDrawing : public osg::Drawable::DrawCallback {
 public:
  void drawImplementation(osg::RenderInfo& /*render_info*/, const osg::Drawable* /*drawable*/) const override {}
};

}  // namespace

DrawsNothing::DrawsNothing(osg::Drawable& drawable) : drawable_(&drawable), before_(drawable.getDrawCallback()) {
  drawable.setDrawCallback(new NoDrawing);
}

DrawsNothing::~DrawsNothing() { drawable_->setDrawCallback(before_); }

std::size_t sliceCount(const osg::Drawable& drawable) {
  const osg::Geometry* const geometry = drawable.asGeometry();
  if (geometry == nullptr || !geometry->getUseVertexBufferObjects() || geometry->getDrawCallback() != nullptr ||
      geometry->getNumPrimitiveSets() != 1) {
    return 1;
  }
  return slicesOf(*geometry->getPrimitiveSet(0));
}

DrawableSlice::DrawableSlice(osg::Drawable& drawable, std::optional<std::size_t> slice) {
  if (!slice || sliceCount(drawable) < 2) {
    return;
  }
  geometry_ = drawable.asGeometry();
  osg::Geometry::PrimitiveSetList& sets = geometry_->getPrimitiveSetList();
  whole_ = sets;
  if (isInstanced(*whole_.front())) {
    geometry_->setDrawCallback(new SomeInstances(*whole_.front(), *slice));
  } else {
    sets = {cut(*whole_.front(), *slice)};
  }
}

DrawableSlice::~DrawableSlice() {
  if (geometry_ != nullptr) {
    geometry_->getPrimitiveSetList() = whole_;
    geometry_->setDrawCallback(nullptr);
  }
}

}  // namespace stillframe::scenegraph
