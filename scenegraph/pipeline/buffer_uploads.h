#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <osg/BufferObject>
#include <osg/State>
#include <osg/ref_ptr>
#include <osgUtil/RenderLeaf>

namespace stillframe::scenegraph {

/// Takes large arrays to OpenGL in bands, so that a step of a frame can end between them: what TextureUploads does for
/// textures.
///
/// OSG fills a buffer object whole when it is first drawn from. Here OSG makes it, empty, and it is filled band by
/// band; until all is there nothing is drawn from it in steps, and before a picture is drawn at once drop() leaves it
/// to OSG. What changes afterwards OSG uploads, or BufferPatches. Thread of the context only.
class BufferUploads {
 public:
  static constexpr std::size_t kBandBytes = std::size_t{4} << 20U;

  /// Goes on with the arrays, indices and texture buffers that `leaf` is drawn from, by a band at least, until
  /// `is_time_up`. Returns whether none is missing that does not come with drawing. `has_indices`: those of the
  /// drawable are drawn as they are.
  [[nodiscard]] bool bring(const osgUtil::RenderLeaf& leaf, bool has_indices, osg::State& state,
                           const std::function<bool()>& is_time_up);
  /// Leaves what is under way to OSG, which begins anew.
  void drop();

 private:
  struct Upload {
    osg::ref_ptr<osg::BufferObject> buffer;
    osg::ref_ptr<osg::GLBufferObject> object;
    unsigned data = 0;      // of the buffer, that is next
    std::size_t bytes = 0;  // of it, that are there
  };
  [[nodiscard]] bool bringOne(const osg::BufferData* data, osg::State& state, const std::function<bool()>& is_time_up);

  std::optional<Upload> under_way_;
};

}  // namespace stillframe::scenegraph
