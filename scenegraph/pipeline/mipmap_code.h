#pragma once

#include <cstdint>
#include <map>
#include <osg/Texture2D>
#include <osgUtil/RenderLeaf>
#include <tuple>

namespace stillframe::scenegraph {

/// What an OpenGL in software makes mipmaps with: it draws each level from the one before, by code that it makes anew
/// in each context and never keeps (llvmpipe; 20 ms for the first level, 15 for the others, for each format). Made here
/// by textures of a few texels, so that these are steps of a frame, and not parts of the one that draws with a texture
/// first. Thread of the context only.
class MipmapCode {
 public:
  /// A texture that is drawn with there for which code is missing; nullptr when there is none.
  [[nodiscard]] const osg::Texture2D* missingFor(const osgUtil::RenderLeaf& leaf) const;
  /// Makes the next code for that texture: twice, and none is missing.
  void make(const osg::Texture2D& texture);
  void clear() { made_.clear(); }

 private:
  using Key = std::tuple<int, bool, bool>;  // format within OpenGL; whether width and height are powers of two
  [[nodiscard]] static Key keyOf(const osg::Texture2D& texture);
  [[nodiscard]] bool isMissing(const osg::Texture2D* texture) const;

  std::map<Key, int> made_;
};

}  // namespace stillframe::scenegraph
