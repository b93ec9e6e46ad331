#pragma once

#include <functional>
#include <optional>
#include <osg/State>
#include <osg/Texture2D>
#include <osg/ref_ptr>
#include <osgUtil/StateGraph>

namespace stillframe::scenegraph {

/// Name that OpenGL has for a texture; 0 where it has none, or there is no texture.
[[nodiscard]] unsigned textureId(const osg::Texture* texture, unsigned context_id);

/// Takes large textures to OpenGL in bands of rows, so that a step of a frame can end between them.
///
/// OSG uploads a texture whole when it is first drawn with. Here it goes, band by band, into a texture object that is
/// handed to OSG when all is there: until then nothing is drawn with it, and whoever draws a picture at once lets OSG
/// upload all as ever. Small textures, and such as have mipmaps, are left to OSG. Thread of the context only.
class TextureUploads {
 public:
  static constexpr std::size_t kBandBytes = std::size_t{1} << 20U;

  TextureUploads() = default;
  TextureUploads(const TextureUploads&) = delete;
  TextureUploads& operator=(const TextureUploads&) = delete;

  /// Goes on with the textures that are drawn with there, by a band at least, until `is_time_up`. Returns whether none
  /// is missing that does not come with drawing.
  [[nodiscard]] bool bring(const osgUtil::StateGraph& graph, osg::State& state,
                           const std::function<bool()>& is_time_up);
  /// Leaves what is under way. The context must be current.
  void drop();

 private:
  struct Upload {
    osg::ref_ptr<osg::Texture2D> texture;
    osg::ref_ptr<osg::Texture::TextureObject> object;
    unsigned modified_count = 0;  // of its image, when it was begun
    int rows = 0;                 // that are there
  };
  [[nodiscard]] bool bringOne(osg::Texture2D& texture, osg::State& state, const std::function<bool()>& is_time_up);

  std::optional<Upload> under_way_;
};

}  // namespace stillframe::scenegraph
