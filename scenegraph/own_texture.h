#pragma once

#include <osg/Drawable>
#include <osg/Referenced>
#include <osg/Texture2D>
#include <osg/ref_ptr>

namespace stillframe::scenegraph {

/// As user data of a drawable: a texture that it draws with beside those of its state, as texts do with their glyphs.
/// Steps of a frame make ready what it needs.
class OwnTexture : public osg::Referenced {
 public:
  explicit OwnTexture(osg::Texture2D* texture) : texture_(texture) {}
  /// nullptr when a drawable names none.
  [[nodiscard]] static const osg::Texture2D* of(const osg::Drawable& drawable) {
    const auto* const own = dynamic_cast<const OwnTexture*>(drawable.getUserData());
    return own == nullptr ? nullptr : own->texture_.get();
  }

 private:
  osg::ref_ptr<osg::Texture2D> texture_;
};

}  // namespace stillframe::scenegraph
