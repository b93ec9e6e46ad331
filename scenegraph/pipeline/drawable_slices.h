#pragma once

#include <cstddef>
#include <optional>
#include <osg/Drawable>
#include <osg/Geometry>
#include <osg/ref_ptr>

namespace stillframe::scenegraph {

/// In how many slices a drawable is drawn, one after the other; 1 for most. More where it has more than some ten
/// thousand triangles, lines or points, or more instances of a few than that. Together they draw what it draws, in the
/// same order.
[[nodiscard]] std::size_t sliceCount(const osg::Drawable& drawable);

/// As long as it lives a drawable draws one of its slices alone; all of it where none is named. Thread of the context
/// only.
///
/// Arrays and buffers stay as they are; indices are copied, which costs nothing beside drawing them in software. Of
/// instances some are drawn, with u_first_instance to say which (shaders/instances.glsl); a program without that cannot
/// tell them apart, and draws them all in the first slice.
class DrawableSlice {
 public:
  DrawableSlice(osg::Drawable& drawable, std::optional<std::size_t> slice);
  ~DrawableSlice();
  DrawableSlice(const DrawableSlice&) = delete;
  DrawableSlice& operator=(const DrawableSlice&) = delete;

 private:
  osg::ref_ptr<osg::Geometry> geometry_;  // none when it is drawn whole
  osg::Geometry::PrimitiveSetList whole_;
};

/// As long as it lives a drawable draws nothing: its state is applied, and its program linked. Thread of the context
/// only.
class DrawsNothing {
 public:
  explicit DrawsNothing(osg::Drawable& drawable);
  ~DrawsNothing();
  DrawsNothing(const DrawsNothing&) = delete;
  DrawsNothing& operator=(const DrawsNothing&) = delete;

 private:
  osg::ref_ptr<osg::Drawable> drawable_;
  osg::ref_ptr<osg::Drawable::DrawCallback> before_;
};

}  // namespace stillframe::scenegraph
