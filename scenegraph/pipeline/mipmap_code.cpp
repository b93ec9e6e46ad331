#include "scenegraph/pipeline/mipmap_code.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include <bit>
#include <osg/Image>
#include <osgUtil/StateGraph>

#include "scenegraph/own_texture.h"

namespace stillframe::scenegraph {
namespace {

constexpr int kCodes = 2;  // of the first level that is read, and of all others

bool isPowerOfTwo(int value) { return value > 0 && std::has_single_bit(static_cast<unsigned>(value)); }

/// Whether OpenGL makes the levels, from an image that has one.
bool wantsMipmaps(const osg::Texture2D& texture) {
  const auto filter = texture.getFilter(osg::Texture::MIN_FILTER);
  const osg::Image* const image = texture.getImage();
  return filter != osg::Texture::NEAREST && filter != osg::Texture::LINEAR && image != nullptr &&
         texture.getUseHardwareMipMapGeneration() && !image->isMipmap() && !image->isCompressed();
}

int formatOf(const osg::Texture2D& texture) {
  return texture.getInternalFormatMode() == osg::Texture::USE_IMAGE_DATA_FORMAT
             ? texture.getImage()->getInternalTextureFormat()
             : texture.getInternalFormat();
}

}  // namespace

MipmapCode::Key MipmapCode::keyOf(const osg::Texture2D& texture) {
  const osg::Image& image = *texture.getImage();
  return {formatOf(texture), isPowerOfTwo(image.s()), isPowerOfTwo(image.t())};
}

bool MipmapCode::isMissing(const osg::Texture2D* texture) const {
  if (texture == nullptr || !wantsMipmaps(*texture)) {
    return false;
  }
  const auto made = made_.find(keyOf(*texture));
  return made == made_.end() || made->second < kCodes;
}

const osg::Texture2D* MipmapCode::missingFor(const osgUtil::RenderLeaf& leaf) const {
  if (const auto* const own = OwnTexture::of(*leaf._drawable); isMissing(own)) {
    return own;
  }
  for (const osgUtil::StateGraph* at = leaf._parent; at != nullptr; at = at->_parent) {
    const osg::StateSet* const set = at->getStateSet();
    for (unsigned unit = 0; set != nullptr && unit < set->getNumTextureAttributeLists(); ++unit) {
      const auto* const texture =
          dynamic_cast<const osg::Texture2D*>(set->getTextureAttribute(unit, osg::StateAttribute::TEXTURE));
      if (isMissing(texture)) {
        return texture;
      }
    }
  }
  return nullptr;
}

void MipmapCode::make(const osg::Texture2D& texture) {
  const Key key = keyOf(texture);
  const auto& [format, is_wide_two, is_high_two] = key;
  const int made = made_[key]++;
  // One level beneath the first, then two: 2 or 3 texels, then 4 or 6.
  const auto side = [made](bool is_power) { return (is_power ? 2 : 3) << made; };
  GLint bound = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
  GLuint small = 0;
  glGenTextures(1, &small);
  glBindTexture(GL_TEXTURE_2D, small);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glTexImage2D(GL_TEXTURE_2D, 0, format, side(is_wide_two), side(is_high_two), 0, texture.getImage()->getPixelFormat(),
               texture.getImage()->getDataType(), nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 1 + made);
  glGenerateMipmap(GL_TEXTURE_2D);
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound));
  glDeleteTextures(1, &small);
}

}  // namespace stillframe::scenegraph
