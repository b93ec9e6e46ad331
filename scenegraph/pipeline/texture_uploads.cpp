#include "scenegraph/pipeline/texture_uploads.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>
#include <osg/Image>

namespace stillframe::scenegraph {
namespace {

bool hasPlainPixels(const osg::Image& image) {
  const GLenum format = image.getPixelFormat();
  const bool is_plain = format == GL_RED || format == GL_RG || format == GL_RGB || format == GL_RGBA;
  return is_plain && image.data() != nullptr && !image.isCompressed() && !image.isMipmap() &&
         image.isDataContiguous() && image.getRowLength() == 0 && image.getBufferObject() == nullptr && image.r() == 1;
}

/// Whether OSG would upload it as it is, in one level, and it is worth more than one band.
bool suits(const osg::Texture2D& texture) {
  const osg::Image* const image = texture.getImage();
  const auto filter = texture.getFilter(osg::Texture::MIN_FILTER);
  return image != nullptr && hasPlainPixels(*image) && image->getTotalSizeInBytes() > TextureUploads::kBandBytes &&
         (filter == osg::Texture::NEAREST || filter == osg::Texture::LINEAR) && texture.getBorderWidth() == 0 &&
         !texture.getResizeNonPowerOfTwoHint() && !texture.getUnRefImageDataAfterApply() &&
         texture.getSubloadCallback() == nullptr && texture.getReadPBuffer() == nullptr;
}

/// An object as OSG's own, with room for the image. Not immutable: OSG may use it again, and allocate it anew.
osg::ref_ptr<osg::Texture::TextureObject> makeObject(const osg::Texture2D& texture, unsigned context_id) {
  const osg::Image& image = *texture.getImage();
  const GLint internal = texture.getInternalFormat();
  osg::ref_ptr<osg::Texture::TextureObject> object = osg::Texture::generateTextureObject(
      &texture, context_id, GL_TEXTURE_2D, 1, static_cast<GLenum>(internal), image.s(), image.t(), 1, 0);
  glBindTexture(GL_TEXTURE_2D, object->id());
  if (!object->isAllocated()) {
    glTexImage2D(GL_TEXTURE_2D, 0, internal, image.s(), image.t(), 0, image.getPixelFormat(), image.getDataType(),
                 nullptr);
    object->setAllocated(true);
  }
  return object;
}

void uploadRows(const osg::Image& image, GLuint object, int first, int count) {
  glBindTexture(GL_TEXTURE_2D, object);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, static_cast<GLint>(image.getPacking()));
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, first, image.s(), count, image.getPixelFormat(), image.getDataType(),
                  image.data(0, static_cast<unsigned>(first)));
}

/// What OSG has bound to the unit that is active is bound again at the end.
class KeptBinding {
 public:
  KeptBinding() { glGetIntegerv(GL_TEXTURE_BINDING_2D, &texture_); }
  ~KeptBinding() { glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(texture_)); }
  KeptBinding(const KeptBinding&) = delete;
  KeptBinding& operator=(const KeptBinding&) = delete;

 private:
  GLint texture_ = 0;
};

}  // namespace

unsigned textureId(const osg::Texture* texture, unsigned context_id) {
  const osg::Texture::TextureObject* const object =
      texture == nullptr ? nullptr : texture->getTextureObject(context_id);
  return object == nullptr ? 0U : object->id();
}

bool TextureUploads::bring(const osgUtil::StateGraph& graph, osg::State& state,
                           const std::function<bool()>& is_time_up) {
  for (const osgUtil::StateGraph* at = &graph; at != nullptr; at = at->_parent) {
    const osg::StateSet* const set = at->getStateSet();
    for (unsigned unit = 0; set != nullptr && unit < set->getNumTextureAttributeLists(); ++unit) {
      auto* const texture =
          dynamic_cast<const osg::Texture2D*>(set->getTextureAttribute(unit, osg::StateAttribute::TEXTURE));
      if (texture != nullptr && !bringOne(const_cast<osg::Texture2D&>(*texture), state, is_time_up)) {
        return false;
      }
    }
  }
  return true;
}

bool TextureUploads::bringOne(osg::Texture2D& texture, osg::State& state, const std::function<bool()>& is_time_up) {
  const unsigned context_id = state.getContextID();
  if (texture.getTextureObject(context_id) != nullptr || !suits(texture)) {
    return true;
  }
  const osg::Image& image = *texture.getImage();
  const KeptBinding binding;
  if (!under_way_ || under_way_->texture != &texture || under_way_->modified_count != image.getModifiedCount()) {
    drop();
    under_way_.emplace(Upload{
        .texture = &texture, .object = makeObject(texture, context_id), .modified_count = image.getModifiedCount()});
  }
  Upload& upload = *under_way_;
  const int band = static_cast<int>(std::max<std::size_t>(1, kBandBytes / image.getRowStepInBytes()));
  do {
    const int count = std::min(band, image.t() - upload.rows);
    uploadRows(image, upload.object->id(), upload.rows, count);
    upload.rows += count;
  } while (upload.rows < image.t() && !is_time_up());
  if (upload.rows < image.t()) {
    return false;
  }
  // As Texture2D::apply() leaves one that it has uploaded itself; filters and the like it sets when they are "dirty".
  texture.setTextureSize(image.s(), image.t());
  texture.setNumMipmapLevels(1);
  texture.setTextureObject(context_id, upload.object);
  texture.getModifiedCount(context_id) = upload.modified_count;
  texture.getTextureParameterDirty(context_id) = 1;
  under_way_.reset();
  return !is_time_up();
}

void TextureUploads::drop() {
  if (under_way_) {
    under_way_->object->release();
    under_way_.reset();
  }
}

}  // namespace stillframe::scenegraph
